// SPDX-License-Identifier: MIT
// panel.mjs - the panel and keys of a row of boards.h, on the pins of an emulated RP2040: an ST7789 or its kin, which
// keeps pixels where commands 2ah, 2bh and 2ch put them.
import fs from 'fs';

const NO = 255, PARALLEL = 8;
const COLUMNS = ['name', 'chip', 'width', 'height', 'x', 'y', 'madctl', 'inverted', 'bus', 'clk', 'data', 'rd', 'cs', 'dc', 'reset',
    'light', 'bus_khz', 'khz', 'up', 'down', 'left', 'right', 'a', 'start', 'level', 'led', 'te'];
const KEYS = { up: 1, down: 2, left: 4, right: 8, a: 16, start: 32 };        // enum display_key

export function read_board(name) {
    const rows = fs.readFileSync(new URL('boards.h', import.meta.url), 'utf8').match(/^BOARD\(.*\)$/mg);
    for (const row of rows) {
        const cells = row.slice(6, -1).split(',').map(cell => cell.trim());
        if (cells[0] === name)
            return Object.fromEntries(COLUMNS.map((column, i) => [column, i < 2 ? cells[i] : cells[i] === 'NO' ? NO : Number(cells[i])]));
    }
    throw new Error(`boards.h has no board ${name}`);
}

const crc_table = new Int32Array(256).map((_, n) => {
    for (let k = 0; k < 8; k++)
        n = n & 1 ? 0xedb88320 ^ n >>> 1 : n >>> 1;
    return n;
});

export class Panel {
    constructor(chip, board) {
        const { mcu } = chip;
        this.board = board;
        this.mcu = mcu;
        this.memory = new Uint16Array(board.width * board.height);
        this.mode = -1;
        this.data = [];
        this.window = [0, 0, 0, 0];             // first and last column, first and last row
        this.high = -1;
        this.bytes = 0;
        this.seen = new Set();                  // commands
        this.wrong = 0;                         // bytes nobody wanted
        this.on_frame = () => {};
        if (board.bus === PARALLEL) {
            mcu.gpio[board.clk].addListener(state => {
                if (state === 1)
                    this.take(mcu.pio[0].pinValues >>> board.data & 255);
            });
        } else {
            const spi = mcu.spi[board.bus];
            const done = chip.clock.createAlarm(() => spi.completeTransmit(0));
            spi.onTransmit = value => {
                this.take(value);
                done.schedule(8e9 / spi.clockFrequency);
            };
        }
        mcu.gpio[board.led].addListener((state, old) => {
            if (state < 2 && old < 2)           // driven, not just made an output
                this.on_frame();
        });
        this.press(0);
        if (board.te !== NO) {                  // high in the 6 % of a sixtieth of a second in which nothing is scanned
            let is_blank = false;
            const scan = chip.clock.createAlarm(() => {
                is_blank = !is_blank && this.seen.has(0x35);
                mcu.gpio[board.te].setInputValue(is_blank);
                scan.schedule(is_blank ? 1e6 : 15.7e6);
            });
            scan.schedule(15.7e6);
        }
    }

    level(pin) {
        return this.mcu.gpio[pin].value;
    }

    take(value) {
        const { board } = this;
        this.bytes++;
        if (this.level(board.cs) !== 0 || (board.reset !== NO && this.level(board.reset) !== 1)) {
            this.wrong++;
            return;
        }
        if (this.level(board.dc) === 0) {
            this.mode = value;
            this.data = [];
            this.seen.add(value);
            if (value === 0x2c) {
                [this.column, , this.row] = this.window;
                this.high = -1;
            }
        } else if (this.mode === 0x2a || this.mode === 0x2b) {
            if (this.data.push(value) === 4) {
                const at = this.mode === 0x2a ? 0 : 2, from = this.mode === 0x2a ? board.x : board.y;
                this.window[at] = (this.data[0] << 8 | this.data[1]) - from;
                this.window[at + 1] = (this.data[2] << 8 | this.data[3]) - from;
            }
        } else if (this.mode === 0x2c) {
            this.pixel(value);
        } else if (this.mode === 0x35) {
            this.wrong += value !== 0;
        } else if (this.mode === 0x36 || this.mode === 0x3a) {
            this.data.push(value);
            if (this.mode === 0x36 ? value !== board.madctl : value !== 0x55)
                this.wrong++;
        } else {
            this.wrong++;
        }
    }

    pixel(value) {
        if (this.high < 0) {
            this.high = value;
            return;
        }
        if (this.column < 0 || this.column >= this.board.width || this.row < 0 || this.row >= this.board.height)
            this.wrong++;
        else
            this.memory[this.row * this.board.width + this.column] = this.high << 8 | value;
        this.high = -1;
        if (++this.column > this.window[1]) {
            this.column = this.window[0];
            this.row++;
        }
    }

    // Lit, awake, inverted where the glass wants it.
    is_on() {
        const wanted = [0x11, 0x29, ...(this.board.inverted ? [0x21] : []), ...(this.board.te !== NO ? [0x35] : [])];
        return wanted.every(code => this.seen.has(code)) && (this.board.light === NO || this.level(this.board.light) === 1);
    }

    // A mask of enum display_key.
    press(mask) {
        for (const [key, bit] of Object.entries(KEYS))
            if (this.board[key] !== NO)
                this.mcu.gpio[this.board[key]].setInputValue(((mask & bit) !== 0) === (this.board.level === 1));
    }

    // By the rule of smear_stats.crc32: bytes as they are sent.
    crc() {
        let c = -1;
        for (const code of this.memory) {
            c = crc_table[(c ^ code >> 8) & 255] ^ c >>> 8;
            c = crc_table[(c ^ code) & 255] ^ c >>> 8;
        }
        return ((c ^ -1) >>> 0).toString(16).padStart(8, '0');
    }

    save(path) {
        const { width, height } = this.board, out = Buffer.alloc(3 * width * height);
        this.memory.forEach((code, i) => {
            out[3 * i] = code >> 11 << 3 | code >> 13;
            out[3 * i + 1] = (code >> 5 & 63) << 2 | code >> 9 & 3;
            out[3 * i + 2] = (code & 31) << 3 | code >> 2 & 7;
        });
        fs.writeFileSync(path, Buffer.concat([Buffer.from(`P6 ${width} ${height} 255\n`), out]));
    }
}
