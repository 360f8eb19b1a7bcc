// SPDX-License-Identifier: MIT
// chip.mjs - an RP2040 with both cores, its flash cache and its bus, on the peripherals of rp2040js (core 0 alone).
//
// What is added to rp2040js: core 1 and its boot, the FIFOs between the cores, a divider and interpolators for each core,
// events, serial flash for the boot ROM, clocks of PIO, and what masters cost each other:
// - the flash cache: 16 kB, 2 ways, lines of 8 bytes; a miss takes MISS cycles, in which the other core cannot reach
//   flash either;
// - RAM in four banks, word by word, and two small ones; two cores that reach for one bank in the same cycle: one waits.
// DMA and the panel's bus are served by the way (one byte in 16 cycles) and charged nothing.
import path from 'path';
import { pathToFileURL } from 'url';
import { core_class, Fault } from './core.mjs';

export { Fault };

// Cycles of 133 MHz: 12 clocks of address, mode and dummies and 16 of data at half the system clock, some of which
// the next words of the line hide.
export const MISS = 45;

const GPIO_IN = 0x04, GPIO_HI_IN = 0x08, FIFO_ST = 0x50, FIFO_WR = 0x54, FIFO_RD = 0x58, SSI_DR0 = 0x60, SSI_RXFLR = 0x24, SSI_SR = 0x28, SSI_SER = 0x10, QSPI_SS_CTRL = 0x0c;

class Bus {
    constructor(chip) {
        this.chip = chip;
        this.contended = false;
        this.tag = new Int32Array(2048).fill(-1);
        this.older = new Uint8Array(1024);      // way that goes next
        this.line = new Int32Array(2).fill(-1); // of each core's last access
        this.free = 0;                          // cycle from which flash can be reached
        this.misses = [0, 0];
        this.waits = [0, 0];
        this.miss = MISS;
        this.lost = 0;                          // to misses of code, of either core, by the instruction that runs
        this.last = new Float64Array(16).fill(-1);      // of bank b by core c: [2 b + c]
    }

    enter(core) {
        const { chip } = this;
        chip.mcu.core = core;
        chip.advance(core.cycles);
    }

    event(cycles) {
        for (const core of this.chip.cores) {
            core.eventRegistered = true;
            this.chip.wake(core, cycles);
        }
    }

    ram(index, address, cycles) {
        const bank = (address & 0x40000) === 0 ? address >> 2 & 3 : address & 0x1000 ? 5 : 4;
        if (this.last[2 * bank + 1 - index] === cycles) {
            this.waits[index]++;
            cycles++;
        }
        this.last[2 * bank + index] = cycles;
        return cycles;
    }

    // A word of flash. Code stays in its line for up to four instructions.
    xip(index, address, cycles, is_code) {
        const line = address >>> 3 & 0x1fffff;
        if (this.contended) {
            if (cycles < this.free) {
                this.waits[index] += this.free - cycles;
                if (is_code === 1)
                    this.lost += this.free - cycles;
                cycles = this.free;
            }
            if (this.last[12 + 1 - index] === cycles) {
                this.waits[index]++;
                cycles++;
            }
            this.last[12 + index] = cycles;
        }
        if (is_code === 1 && line === this.line[index])
            return cycles;
        if (is_code === 1)
            this.line[index] = line;
        const at = (line & 1023) * 2, { tag } = this;
        if (tag[at] === line) {
            this.older[line & 1023] = 1;
            return cycles;
        }
        if (tag[at + 1] === line) {
            this.older[line & 1023] = 0;
            return cycles;
        }
        const way = this.older[line & 1023];
        tag[at + way] = line;
        this.older[line & 1023] = 1 - way;
        this.misses[index]++;
        if (is_code === 1)
            this.lost += this.miss;
        this.free = cycles + this.miss;
        return cycles + this.miss;
    }

    // Beyond the two cycles of memory.
    peripheral(address) {
        return address >>> 28 === 13 ? -1 : address >>> 28 === 4 ? 3 : 0;
    }
}

// What each core has of its own in SIO.
class Sio {
    constructor(chip, RPSIO) {
        this.chip = chip;
        this.part = [0, 1].map(() => new RPSIO(chip.mcu));
        for (const part of this.part)
            part.updateHardwareDivider = Sio.divide;
        this.fifo = [[], []];                   // to core 0, to core 1
    }

    // Instructions that wait for the result pay for it.
    static divide(signed) {
        const a = this.divDividend, b = this.divDivisor;
        if ((b | 0) === 0) {
            this.divQuotient = signed && (a | 0) < 0 ? 1 : -1;
            this.divRemainder = a;
        } else if (signed) {
            this.divQuotient = Math.trunc((a | 0) / (b | 0));
            this.divRemainder = (a | 0) % (b | 0);
        } else {
            this.divQuotient = Math.floor((a >>> 0) / (b >>> 0));
            this.divRemainder = (a >>> 0) % (b >>> 0);
        }
        this.divCSR = 3;
    }

    get gpioValue() { return this.part[0].gpioValue; }
    get gpioOutputEnable() { return this.part[0].gpioOutputEnable; }
    get qspiGpioValue() { return this.part[0].qspiGpioValue; }
    get qspiGpioOutputEnable() { return this.part[0].qspiGpioOutputEnable; }

    readUint32(offset) {
        const core = this.chip.mcu.core.index;
        switch (offset) {
        case 0:
            return core;
        case GPIO_IN:
            this.chip.on_look?.();
            break;
        case GPIO_HI_IN:
            return 0x3f;                        // nobody presses BOOTSEL
        case FIFO_ST:
            return (this.fifo[core].length > 0 ? 1 : 0) | (this.fifo[1 - core].length < 8 ? 2 : 0);
        case FIFO_RD:
            return this.fifo[core].length > 0 ? this.fifo[core].shift() : 0;
        }
        return this.part[offset >= 0x60 && offset < 0x100 ? core : 0].readUint32(offset);
    }

    writeUint32(offset, value) {
        const core = this.chip.mcu.core.index;
        if (offset === FIFO_ST)
            return;
        if (offset === FIFO_WR) {
            if (this.fifo[1 - core].length < 8)
                this.fifo[1 - core].push(value);
            this.chip.bus.event(this.chip.cores[core].cycles);
            return;
        }
        this.part[offset >= 0x60 && offset < 0x100 ? core : 0].writeUint32(offset, value);
    }
}

// Serial flash behind the SSI, as far as the boot ROM and boot2 ask: reads (03h), status (05h, 35h); all else is taken in
// silence. What lies at 0x10000000 is always there, whatever mode boot2 sets.
function serial_flash(ssi, pins, flash) {
    let sent = [], back = [];
    const read = ssi.readUint32.bind(ssi), write = ssi.writeUint32.bind(ssi);
    const select = () => { sent = []; };
    pins.readUint32 = () => 0;
    pins.writeUint32Atomic = offset => {
        if (offset === QSPI_SS_CTRL)            // chip select by hand
            select();
    };
    ssi.readUint32 = offset => {
        if (offset === SSI_RXFLR)
            return back.length;
        if (offset === SSI_SR)
            return 6 | (back.length > 0 ? 8 : 0);
        if (offset === SSI_DR0)
            return back.length > 0 ? back.shift() : 0;
        return read(offset);
    };
    ssi.writeUint32 = (offset, value) => {
        if (offset === SSI_SER)
            select();
        if (offset !== SSI_DR0)
            return write(offset, value);
        sent.push(value & 255);
        const at = sent.length - 5;
        back.push(sent[0] === 3 && at >= 0 ? flash[(sent[1] << 16 | sent[2] << 8 | sent[3]) + at] : 0);
        if (sent[0] === 5 || sent[0] === 0x35)
            sent = sent.length === 2 ? [] : sent;
    };
}

// A state machine by the chip's clock (rp2040js lets them run on timers of the host), while it has something to send.
function clock_pio(pio, clock, hz) {
    const [machine] = pio.machines, write = machine.writeFIFO.bind(machine);
    const alarm = clock.createAlarm(() => {
        pio.step();
        if (machine.waiting && machine.txFIFO.empty)
            alarm.scheduled = false;
        else
            go();
    });
    const go = () => alarm.schedule((machine.clockDivInt + machine.clockDivFrac / 256) * 1e9 / hz);
    pio.run = go;
    machine.writeFIFO = value => {
        write(value);
        if (!alarm.scheduled && machine.enabled)
            go();
    };
}

export async function make_chip({ library, bootrom, image, hz = 133e6 }) {
    const part = file => import(pathToFileURL(path.join(library, 'dist/esm', file)));
    const { RP2040 } = await part('rp2040.js');
    const { SimulationClock } = await part('clock/simulation-clock.js');
    const { CortexM0Core } = await part('cortex-m0-core.js');
    const { RPSIO } = await part('sio.js');
    const Core = core_class(CortexM0Core);

    const clock = new SimulationClock(hz), mcu = new RP2040(clock);
    const chip = { mcu, clock, hz, Plain: CortexM0Core, cores: [] };
    mcu.logger = { debug() {}, info() {}, warn() {}, error(where, what) { chip.complain?.(`${where}: ${what}`); } };
    mcu.bootrom.set(bootrom);
    mcu.flash.fill(0xff);
    load_uf2(mcu.flash, image);

    const bus = chip.bus = new Bus(chip);
    chip.cores = [new Core(mcu, 0, bus), new Core(mcu, 1, bus)];
    mcu.core = chip.cores[0];
    mcu.sio = new Sio(chip, RPSIO);
    mcu.setInterrupt = (irq, value) => {
        for (const core of chip.cores)
            core.setInterrupt(irq, value);
    };
    serial_flash(mcu.peripherals[0x18000], mcu.peripherals[0x40018], mcu.flash);
    mcu.peripherals[0x40064].readUint32 = () => 0x100;          // switched on, not restarted by a debugger
    for (const core of chip.cores) {
        mcu.core = core;
        core.reset();
    }

    for (const pio of mcu.pio)
        clock_pio(pio, clock, hz);

    let now = 0;                                // cycles up to which peripherals have come
    chip.advance = cycles => {
        if (cycles > now) {
            now = cycles;
            clock.tick(Math.max(0, now * 1e9 / hz - clock.nanos));
        }
    };
    chip.wake = (core, cycles) => {
        if (!core.waiting)
            return;
        core.waiting = false;
        if (core.cycles < cycles) {
            core.sleeping += cycles - core.cycles;
            core.cycles = cycles;
        }
    };
    // Interrupts wake, too; rp2040js's core does that by itself.
    for (const core of chip.cores) {
        let waiting = false;
        Object.defineProperty(core, 'waiting', {
            get: () => waiting,
            set: value => {
                if (waiting && !value && core.cycles < now) {
                    core.sleeping += now - core.cycles;
                    core.cycles = now;
                }
                waiting = value;
            },
        });
    }

    // Until done() is true. The core that is behind runs; quantum: by how many cycles it may come ahead of the other.
    chip.run = (done, quantum) => {
        const [first, second] = chip.cores;
        while (!done()) {
            const alarm = clock.nextAlarm ? Math.ceil(clock.nextAlarm.nanos * hz / 1e9) : Infinity;
            const asleep0 = first.waiting, asleep1 = second.waiting;
            if (asleep0 && asleep1) {
                if (alarm === Infinity)
                    throw new Fault('both cores sleep for ever');
                chip.advance(Math.max(alarm, now + 1));
                continue;
            }
            const core = asleep1 || (!asleep0 && first.cycles <= second.cycles) ? first : second;
            const other = core === first ? second : first;
            const limit = other.waiting ? Math.max(alarm, core.cycles + 1) : Math.max(Math.min(alarm, other.cycles + quantum), core.cycles + 1);
            core.run(limit === Infinity ? core.cycles + 100000 : limit);
            const reached = other.waiting ? core.cycles : Math.min(core.cycles, other.cycles);
            if (reached >= alarm)
                chip.advance(reached);
        }
    };
    return chip;
}

export function load_uf2(flash, uf2) {
    if (uf2.length === 0 || uf2.length % 512 !== 0)
        throw new Error('is no UF2 file');
    for (let o = 0; o < uf2.length; o += 512) {
        if (uf2.readUInt32LE(o) !== 0x0a324655 || uf2.readUInt32LE(o + 508) !== 0x0ab16f30)
            throw new Error(`has no UF2 block at ${o}`);
        if (uf2.readUInt32LE(o + 28) !== 0xe48bff56)
            throw new Error(`is of the family ${uf2.readUInt32LE(o + 28).toString(16)}, not of the RP2040's`);
        const address = uf2.readUInt32LE(o + 12), size = uf2.readUInt32LE(o + 16);
        flash.set(uf2.subarray(o + 32, o + 32 + size), address - 0x10000000);
    }
}
