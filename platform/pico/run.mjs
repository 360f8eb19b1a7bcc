// SPDX-License-Identifier: MIT
// run.mjs - boots a UF2 image on an emulated board of boards.h: boot ROM, boot2, both cores, panel, keys.
//
//     node run.mjs [OPTION VALUE]... IMAGE.uf2 [ARGUMENT...]
//
// Text of UART0 goes to standard output; a line "#exit N" ends the run with that status. Options:
//     --board NAME     the row of boards.h [breakout]
//     --frames N       ends after N frames on the panel; prints the CRC of each
//     --keys N:MASK,.. keys (enum display_key) that are held from frame N on: when the program has looked at them before the
//                      first frame, and then N times
//     --cost FILE      writes what each frame took: cycles of each core, misses of the flash cache, bytes sent
//     --shot FILE      the panel's last picture, PPM
//     --profile FILE   by address, of both cores: cycles, instructions, cycles that waited for code from flash
//     --exact 1        cores take turns by the cycle and wait for each other's banks of memory; else every 200 cycles
//     --selftest N     the first N instructions of core 0 side by side with rp2040js's own interpreter
// RP2040JS: the folder of npm's package; PICO_BOOTROM: the chip's boot ROM (a module that exports bootromB1, or 16 kB).
import fs from 'fs';
import path from 'path';
import { pathToFileURL } from 'url';
import { Fault, make_chip } from './chip.mjs';
import { Panel, read_board } from './panel.mjs';

function fail(text) {
    process.stderr.write(`run.mjs: ${text}\n`);
    process.exit(2);
}

const options = { board: 'breakout', exact: '0' };
let at = 2;
for (; process.argv[at]?.startsWith('--'); at += 2)
    options[process.argv[at].slice(2)] = process.argv[at + 1];
const [file, ...words] = process.argv.slice(at);
if (file === undefined)
    fail('which image? node run.mjs IMAGE.uf2');

const library = process.env.RP2040JS || 'build/tools/node_modules/rp2040js';
if (!fs.existsSync(path.join(library, 'package.json')))
    fail(`no rp2040js in ${library}: npm install --prefix build/tools rp2040js@1.4.1, or RP2040JS=FOLDER`);
const rom = process.env.PICO_BOOTROM || '../shared/target-probes/rp2040/bootrom.mjs';
if (!fs.existsSync(rom))
    fail(`no boot ROM in ${rom}: PICO_BOOTROM=FILE, the RP2040's bootrom.bin (16 kB)`);
const bootrom = /js$/.test(rom) ? (await import(pathToFileURL(path.resolve(rom)))).bootromB1
    : new Uint32Array(fs.readFileSync(rom).buffer.slice(0, 16384));

// Arguments go where board.c looks for them.
const image = fs.readFileSync(file);
function put_arguments(flash, text) {
    const mark = Buffer.from('smear arguments\0');
    const where = Buffer.from(flash.buffer).indexOf(mark);
    if (where < 0)
        fail(`${file} takes no arguments`);
    flash.set(Buffer.from(text + '\0'), where + mark.length);
}

let chip;
try {
    chip = await make_chip({ library, bootrom, image });
} catch (error) {
    fail(`${file} ${error.message}`);
}
if (words.length > 0)
    put_arguments(chip.mcu.flash, words.join(' '));
const board = read_board(options.board);
const panel = new Panel(chip, board);

const keys = (options.keys ?? '').split(',').filter(Boolean).map(pair => pair.split(':').map(Number));
const wanted = Number(options.frames ?? Infinity), cost = [];
let frames = 0, looks = 0, status = null, line = '', before = null;

function reading() {
    const [a, b] = chip.cores;
    return { cycles: Math.max(a.cycles, b.waiting ? 0 : b.cycles), misses: [...chip.bus.misses], waits: [...chip.bus.waits], bytes: panel.bytes,
        instructions: [a.instructions, b.instructions] };
}

function hold_keys(frame) {
    for (const [from, mask] of keys)
        if (from === frame)
            panel.press(mask);
}

// A program looks at the keys once before its loop and once for each frame, while the frame before may still be on its way.
chip.on_look = () => {
    if (++looks > 2)
        hold_keys(looks - 2);
};

panel.on_frame = () => {
    const now = reading();
    if (before === null)
        before = { cycles: 0, misses: [0, 0], waits: [0, 0], bytes: 0, instructions: [0, 0] };
    const minus = key => now[key].map((value, i) => value - before[key][i]);
    cost.push([frames, now.cycles - before.cycles, ...minus('misses'), ...minus('waits'), ...minus('instructions'), now.bytes - before.bytes]);
    before = now;
    if (options.frames !== undefined)
        console.log(`${frames} ${panel.crc()}`);
    frames++;
    if (frames >= wanted)
        status = 0;
};
hold_keys(0);

chip.mcu.uart[0].onByte = value => {
    if (value !== 10) {
        line += String.fromCharCode(value);
        return;
    }
    const exit = line.match(/^#exit (\d+)$/);
    if (exit)
        status = Number(exit[1]);
    else
        console.log(line);
    line = '';
};
chip.complain = text => process.stderr.write(`run.mjs: ${text}\n`);
if (options.profile !== undefined)
    for (const core of chip.cores)
        core.start_profile();
chip.bus.contended = options.exact === '1';

const core0 = chip.cores[0];
try {
    if (options.selftest !== undefined) {
        const { self_test } = await import('./selftest.mjs');
        self_test(chip, Number(options.selftest));
        status = 0;
    }
    const limit = Number(process.env.LIMIT_CYCLES ?? 1e12);
    chip.run(() => status !== null || core0.cycles > limit, chip.bus.contended ? 1 : 200);
    if (status === null)
        fail('ran out of time');
} catch (error) {
    if (!(error instanceof Fault))
        throw error;
    fail(error.message);
}

if (options.cost !== undefined)
    fs.writeFileSync(options.cost, cost.map(row => row.join(' ') + '\n').join(''));
if (options.shot !== undefined)
    panel.save(options.shot);
if (options.profile !== undefined) {
    const [a, b] = chip.cores, out = [];
    for (let i = 0; i < a.profile.length; i++)
        if (a.profile[i] + b.profile[i] > 0) {
            const address = i < 0x800000 ? 0x10000000 + 2 * i : 0x20000000 + 2 * (i - 0x800000);
            out.push([address.toString(16), ...['profile', 'executed', 'lost'].map(what => a[what][i] + b[what][i])].join(' ') + '\n');
        }
    fs.writeFileSync(options.profile, out.join(''));
}
if (panel.wrong > 0)
    fail(`${panel.wrong} bytes that the panel did not want`);
if (frames > 0 && !panel.is_on())
    fail('the panel is dark: it was not woken, or its backlight is off');
process.exitCode = status;
