// SPDX-License-Identifier: MIT
// core.mjs - a Cortex-M0+ of an RP2040 for rp2040js: its own core with an interpreter that is an order of magnitude
// faster and counts cycles by the data sheets.
//
// Common instructions on RAM, flash and boot ROM are executed here; all others, exceptions and peripherals by rp2040js.
// `node panel.mjs selftest` runs both side by side.
//
// Cycles: Cortex-M0+ TRM, table 3-1, with the multiplier of one cycle; peripherals as rp2040js charges them. Beyond
// that `bus` charges what several masters cost each other: see bus.mjs.
export class Fault extends Error {}

// Bits of a register list.
const count = new Uint8Array(256).map((_, i) => [...i.toString(2)].filter(b => b === '1').length);

export const core_class = CortexM0Core => class Core extends CortexM0Core {
    constructor(mcu, index, bus) {
        super(mcu);
        this.index = index;
        this.bus = bus;
        this.signed = new Int32Array(this.registers.buffer);
        this.ram = mcu.sram;
        this.ram16 = new Uint16Array(mcu.sram.buffer);
        this.ram32 = new Int32Array(mcu.sram.buffer);
        this.flash = mcu.flash;
        this.flash16 = new Uint16Array(mcu.flash.buffer);
        this.flash32 = new Int32Array(mcu.flash.buffer);
        this.rom16 = new Uint16Array(mcu.bootrom.buffer);
        this.rom32 = new Int32Array(mcu.bootrom.buffer);
        this.rom8 = new Uint8Array(mcu.bootrom.buffer);
        this.instructions = 0;
        this.sleeping = 0;              // cycles
        this.word = -1;                 // that was fetched last
        this.profile = null;            // Float64Array: cycles by halfword of flash or RAM; see profile_at
    }

    reset() {
        super.reset();
        this.word = -1;
    }

    // What the TRM charges for interrupts, and rp2040js does not.
    exceptionEntry(number) {
        super.exceptionEntry(number);
        this.cycles += 15;
    }

    exceptionReturn(code) {
        super.exceptionReturn(code);
        this.cycles += 10;
    }

    fault(what, address) {
        throw new Fault(`core ${this.index} at ${(this.registers[15] >>> 0).toString(16)}: ${what} ${(address >>> 0).toString(16)}`);
    }

    // A peripheral: it sees the time of this core.
    outside(cycles) {
        this.cycles = cycles;
        this.bus.enter(this);
    }

    // Runs until `limit` cycles or until something may have happened that concerns other parts of the chip. Each pass
    // of the loop is one instruction.
    run(limit) {
        if (this.interruptsUpdated && this.checkForInterrupts())
            this.waiting = false;
        const r = this.signed, { ram, ram16, ram32, flash, flash16, flash32, rom16, rom32, rom8, bus, index, profile } = this;
        const contended = bus.contended;
        let nz = this.Z ? 0 : this.N ? -1 : 1, c = this.C ? 1 : 0, v = this.V ? 1 : 0;
        let cycles = this.cycles, pc = r[15], word = this.word, done = 0, live = true;
        let a = 0, b = 0, x = 0, at = 0, from = 0, i = 0;

        while (cycles < limit && live) {
            const began = cycles;
            bus.lost = 0;
            let op;
            from = pc;
            if (pc >>> 28 === 2) {
                op = ram16[(pc & 0x7ffff) >> 1];
                if (word !== pc >> 2) {
                    word = pc >> 2;
                    if (contended)
                        cycles = bus.ram(index, pc, cycles);
                }
            } else if (pc >>> 24 === 0x10) {
                op = flash16[(pc & 0xffffff) >> 1];
                if (word !== pc >> 2) {
                    word = pc >> 2;
                    cycles = bus.xip(index, pc, cycles, 1);
                }
            } else if (pc >>> 0 < 0x4000) {
                op = rom16[pc >> 1];
            } else {
                r[15] = pc;
                this.fault('runs from', pc);
            }
            pc += 2;
            done++;
            switch (op >> 11) {
            case 0: {                                               // LSLS (immediate), MOVS (register)
                const s = op >> 6 & 31;
                x = r[op >> 3 & 7];
                if (s !== 0) {
                    c = x >>> 32 - s & 1;
                    x <<= s;
                }
                nz = r[op & 7] = x;
                cycles++;
                break;
            }
            case 1: {                                               // LSRS (immediate)
                const s = op >> 6 & 31;
                x = r[op >> 3 & 7];
                c = s === 0 ? x >>> 31 : x >>> s - 1 & 1;
                nz = r[op & 7] = s === 0 ? 0 : x >>> s;
                cycles++;
                break;
            }
            case 2: {                                               // ASRS (immediate)
                const s = op >> 6 & 31;
                x = r[op >> 3 & 7];
                c = s === 0 ? x >>> 31 : x >> s - 1 & 1;
                nz = r[op & 7] = s === 0 ? x >> 31 : x >> s;
                cycles++;
                break;
            }
            case 3:                                                 // ADDS, SUBS (register, 3 bits)
                a = r[op >> 3 & 7];
                b = op & 0x400 ? op >> 6 & 7 : r[op >> 6 & 7];
                if (op & 0x200) {
                    x = a - b | 0;
                    c = a >>> 0 >= b >>> 0 ? 1 : 0;
                    v = ((a ^ b) & (a ^ x)) >>> 31;
                } else {
                    x = a + b | 0;
                    c = x >>> 0 < a >>> 0 ? 1 : 0;
                    v = ((a ^ x) & (b ^ x)) >>> 31;
                }
                nz = r[op & 7] = x;
                cycles++;
                break;
            case 4:                                                 // MOVS
                nz = r[op >> 8 & 7] = op & 255;
                cycles++;
                break;
            case 5:                                                 // CMP (8 bits)
                a = r[op >> 8 & 7];
                b = op & 255;
                nz = a - b | 0;
                c = a >>> 0 >= b ? 1 : 0;
                v = ((a ^ b) & (a ^ nz)) >>> 31;
                cycles++;
                break;
            case 6:                                                 // ADDS (8 bits)
                a = r[op >> 8 & 7];
                b = op & 255;
                nz = r[op >> 8 & 7] = a + b | 0;
                c = nz >>> 0 < a >>> 0 ? 1 : 0;
                v = ((a ^ nz) & (b ^ nz)) >>> 31;
                cycles++;
                break;
            case 7:                                                 // SUBS (8 bits)
                a = r[op >> 8 & 7];
                b = op & 255;
                nz = r[op >> 8 & 7] = a - b | 0;
                c = a >>> 0 >= b ? 1 : 0;
                v = ((a ^ b) & (a ^ nz)) >>> 31;
                cycles++;
                break;
            case 8: {
                const d = op & 7, m = op >> 3 & 7;
                cycles++;
                switch (op >> 6 & 31) {
                case 0: nz = r[d] &= r[m]; break;                   // ANDS
                case 1: nz = r[d] ^= r[m]; break;                   // EORS
                case 2: {                                           // LSLS (register)
                    const s = r[m] & 255;
                    x = r[d];
                    if (s !== 0) {
                        c = s > 32 ? 0 : s === 32 ? x & 1 : x >>> 32 - s & 1;
                        x = s >= 32 ? 0 : x << s;
                    }
                    nz = r[d] = x;
                    break;
                }
                case 3: {                                           // LSRS (register)
                    const s = r[m] & 255;
                    x = r[d];
                    if (s !== 0) {
                        c = s > 32 ? 0 : x >>> s - 1 & 1;
                        x = s >= 32 ? 0 : x >>> s;
                    }
                    nz = r[d] = x;
                    break;
                }
                case 4: {                                           // ASRS (register)
                    const s = r[m] & 255;
                    x = r[d];
                    if (s !== 0) {
                        c = s >= 32 ? x >>> 31 : x >> s - 1 & 1;
                        x = s >= 32 ? x >> 31 : x >> s;
                    }
                    nz = r[d] = x;
                    break;
                }
                case 5:                                             // ADCS
                    a = r[d];
                    b = r[m];
                    x = a + b + c | 0;
                    c = (a >>> 0) + (b >>> 0) + c > 0xffffffff ? 1 : 0;
                    v = ((a ^ x) & (b ^ x)) >>> 31;
                    nz = r[d] = x;
                    break;
                case 6:                                             // SBCS
                    a = r[d];
                    b = r[m];
                    x = a - b - (1 - c) | 0;
                    c = (a >>> 0) - (b >>> 0) - (1 - c) >= 0 ? 1 : 0;
                    v = ((a ^ b) & (a ^ x)) >>> 31;
                    nz = r[d] = x;
                    break;
                case 7: {                                           // RORS
                    const s = r[m] & 255;
                    x = r[d];
                    if (s !== 0) {
                        x = x >>> (s & 31) | x << (32 - s & 31);
                        c = x >>> 31;
                    }
                    nz = r[d] = x;
                    break;
                }
                case 8: nz = r[d] & r[m]; break;                    // TST
                case 9:                                             // RSBS
                    b = r[m];
                    nz = r[d] = -b | 0;
                    c = b === 0 ? 1 : 0;
                    v = (b & nz) >>> 31;
                    break;
                case 10:                                            // CMP
                    a = r[d];
                    b = r[m];
                    nz = a - b | 0;
                    c = a >>> 0 >= b >>> 0 ? 1 : 0;
                    v = ((a ^ b) & (a ^ nz)) >>> 31;
                    break;
                case 11:                                            // CMN
                    a = r[d];
                    b = r[m];
                    nz = a + b | 0;
                    c = nz >>> 0 < a >>> 0 ? 1 : 0;
                    v = ((a ^ nz) & (b ^ nz)) >>> 31;
                    break;
                case 12: nz = r[d] |= r[m]; break;                  // ORRS
                case 13: nz = r[d] = Math.imul(r[d], r[m]); break;  // MULS
                case 14: nz = r[d] &= ~r[m]; break;                 // BICS
                case 15: nz = r[d] = ~r[m]; break;                  // MVNS
                default: {                                          // registers 8 to 15
                    const to = op & 7 | op >> 4 & 8, of = op >> 3 & 15;
                    b = of === 15 ? pc + 2 : r[of];
                    switch (op >> 8 & 3) {
                    case 0:                                         // ADD
                        x = (to === 15 ? pc + 2 : r[to]) + b | 0;
                        break;
                    case 1:                                         // CMP
                        a = r[to];
                        nz = a - b | 0;
                        c = a >>> 0 >= b >>> 0 ? 1 : 0;
                        v = ((a ^ b) & (a ^ nz)) >>> 31;
                        break;
                    case 2:                                         // MOV
                        x = b;
                        break;
                    case 3:                                         // BX, BLX
                        if (op & 0x80) {
                            r[14] = pc | 1;
                        } else if (b >>> 28 === 15) {               // from an interrupt
                            this.cycles = cycles + 1;
                            r[15] = pc;
                            this.N = nz < 0;
                            this.Z = nz === 0;
                            this.C = c === 1;
                            this.V = v === 1;
                            this.BXWritePC(b >>> 0);
                            this.instructions += done;
                            this.word = -1;
                            return;
                        }
                        pc = b & ~1;
                        cycles++;
                        word = -1;
                        break;
                    }
                    if ((op >> 8 & 1) === 0) {
                        if (to === 15) {
                            pc = x & ~1;
                            cycles++;
                            word = -1;
                        } else {
                            r[to] = to === 13 ? x & ~3 : x;
                        }
                    }
                }
                }
                break;
            }
            case 9:                                                 // LDR (literal)
                at = (pc + 2 & ~3) + ((op & 255) << 2);
                cycles += 2;
                if (at >>> 28 === 2) {
                    if (contended)
                        cycles = bus.ram(index, at, cycles);
                    r[op >> 8 & 7] = ram32[(at & 0x7ffff) >> 2];
                } else if (at >>> 24 === 0x10) {
                    cycles = bus.xip(index, at, cycles, 0);
                    r[op >> 8 & 7] = flash32[(at & 0xffffff) >> 2];
                } else {
                    r[op >> 8 & 7] = rom32[at >> 2];
                }
                break;
            case 10:                                                // loads and stores, register offset
                at = r[op >> 3 & 7] + r[op >> 6 & 7] | 0;
                switch (op >> 9 & 3) {
                case 0: i = 4; break;                               // STR
                case 1: i = 2; break;                               // STRH
                case 2: i = 1; break;                               // STRB
                case 3: i = -1; break;                              // LDRSB
                }
                if (i > 0) {
                    x = r[op & 7];
                } else {
                    cycles += 2;
                    if (at >>> 28 === 2) {
                        if (contended)
                            cycles = bus.ram(index, at, cycles);
                        r[op & 7] = ram[at & 0x7ffff] << 24 >> 24;
                    } else if (at >>> 24 === 0x10) {
                        cycles = bus.xip(index, at, cycles, 0);
                        r[op & 7] = flash[at & 0xffffff] << 24 >> 24;
                    } else if (at >>> 0 < 0x4000) {
                        r[op & 7] = rom8[at] << 24 >> 24;
                    } else {
                        r[15] = from;
                        this.outside(cycles);
                        r[op & 7] = this.rp2040.readUint8(at >>> 0) << 24 >> 24;
                        live = false;
                    }
                    break;
                }
                cycles += 2;
                if (at >>> 28 === 2) {
                    if (at & i - 1 || (at & 0x7ffff) >= 0x42000) {
                        r[15] = from;
                        this.fault('store to', at);
                    }
                    if (contended)
                        cycles = bus.ram(index, at, cycles);
                    if (i === 4)
                        ram32[(at & 0x7ffff) >> 2] = x;
                    else if (i === 2)
                        ram16[(at & 0x7ffff) >> 1] = x;
                    else
                        ram[at & 0x7ffff] = x;
                    break;
                }
                live = false;
                break;
            case 11: {                                              // LDR, LDRH, LDRB, LDRSH, register offset
                at = r[op >> 3 & 7] + r[op >> 6 & 7] | 0;
                const k = op >> 9 & 3;
                cycles += 2;
                if (k === 0 ? at & 3 : k !== 2 ? at & 1 : 0) {
                    r[15] = from;
                    this.fault('load from', at);
                }
                if (at >>> 28 === 2) {
                    if (contended)
                        cycles = bus.ram(index, at, cycles);
                    b = at & 0x7ffff;
                    x = k === 0 ? ram32[b >> 2] : k === 1 ? ram16[b >> 1] : k === 2 ? ram[b] : ram16[b >> 1] << 16 >> 16;
                } else if (at >>> 24 === 0x10) {
                    cycles = bus.xip(index, at, cycles, 0);
                    b = at & 0xffffff;
                    x = k === 0 ? flash32[b >> 2] : k === 1 ? flash16[b >> 1] : k === 2 ? flash[b] : flash16[b >> 1] << 16 >> 16;
                } else if (at >>> 0 < 0x4000) {
                    x = k === 0 ? rom32[at >> 2] : k === 1 ? rom16[at >> 1] : k === 2 ? rom8[at] : rom16[at >> 1] << 16 >> 16;
                } else {
                    r[15] = from;
                    this.outside(cycles);
                    x = k === 0 ? this.rp2040.readUint32(at >>> 0) : k === 1 ? this.rp2040.readUint16(at >>> 0)
                        : k === 2 ? this.rp2040.readUint8(at >>> 0) : this.rp2040.readUint16(at >>> 0) << 16 >> 16;
                    cycles += bus.peripheral(at);
                    live = false;
                }
                r[op & 7] = x;
                break;
            }
            case 12:                                                // STR (5 bits)
            case 18:                                                // STR (SP)
                at = op >> 11 === 12 ? r[op >> 3 & 7] + (op >> 4 & 0x7c) | 0 : r[13] + ((op & 255) << 2) | 0;
                x = op >> 11 === 12 ? r[op & 7] : r[op >> 8 & 7];
                i = 4;
                cycles += 2;
                if (at >>> 28 === 2) {
                    if (at & 3 || (at & 0x7ffff) >= 0x42000) {
                        r[15] = from;
                        this.fault('store to', at);
                    }
                    if (contended)
                        cycles = bus.ram(index, at, cycles);
                    ram32[(at & 0x7ffff) >> 2] = x;
                } else {
                    live = false;
                }
                break;
            case 13:                                                // LDR (5 bits)
            case 19: {                                              // LDR (SP)
                at = op >> 11 === 13 ? r[op >> 3 & 7] + (op >> 4 & 0x7c) | 0 : r[13] + ((op & 255) << 2) | 0;
                const to = op >> 11 === 13 ? op & 7 : op >> 8 & 7;
                cycles += 2;
                if (at & 3) {
                    r[15] = from;
                    this.fault('load from', at);
                }
                if (at >>> 28 === 2) {
                    if (contended)
                        cycles = bus.ram(index, at, cycles);
                    r[to] = ram32[(at & 0x7ffff) >> 2];
                } else if (at >>> 24 === 0x10) {
                    cycles = bus.xip(index, at, cycles, 0);
                    r[to] = flash32[(at & 0xffffff) >> 2];
                } else if (at >>> 0 < 0x4000) {
                    r[to] = rom32[at >> 2];
                } else {
                    r[15] = from;
                    this.outside(cycles);
                    r[to] = this.rp2040.readUint32(at >>> 0);
                    cycles += bus.peripheral(at);
                    live = false;
                }
                break;
            }
            case 14:                                                // STRB (5 bits)
                at = r[op >> 3 & 7] + (op >> 6 & 31) | 0;
                x = r[op & 7];
                i = 1;
                cycles += 2;
                if (at >>> 28 === 2 && (at & 0x7ffff) < 0x42000) {
                    if (contended)
                        cycles = bus.ram(index, at, cycles);
                    ram[at & 0x7ffff] = x;
                } else {
                    live = false;
                }
                break;
            case 15:                                                // LDRB (5 bits)
                at = r[op >> 3 & 7] + (op >> 6 & 31) | 0;
                cycles += 2;
                if (at >>> 28 === 2) {
                    if (contended)
                        cycles = bus.ram(index, at, cycles);
                    r[op & 7] = ram[at & 0x7ffff];
                } else if (at >>> 24 === 0x10) {
                    cycles = bus.xip(index, at, cycles, 0);
                    r[op & 7] = flash[at & 0xffffff];
                } else if (at >>> 0 < 0x4000) {
                    r[op & 7] = rom8[at];
                } else {
                    r[15] = from;
                    this.outside(cycles);
                    r[op & 7] = this.rp2040.readUint8(at >>> 0);
                    cycles += bus.peripheral(at);
                    live = false;
                }
                break;
            case 16:                                                // STRH (5 bits)
                at = r[op >> 3 & 7] + (op >> 5 & 62) | 0;
                x = r[op & 7];
                i = 2;
                cycles += 2;
                if (at >>> 28 === 2) {
                    if (at & 1 || (at & 0x7ffff) >= 0x42000) {
                        r[15] = from;
                        this.fault('store to', at);
                    }
                    if (contended)
                        cycles = bus.ram(index, at, cycles);
                    ram16[(at & 0x7ffff) >> 1] = x;
                } else {
                    live = false;
                }
                break;
            case 17:                                                // LDRH (5 bits)
                at = r[op >> 3 & 7] + (op >> 5 & 62) | 0;
                cycles += 2;
                if (at & 1) {
                    r[15] = from;
                    this.fault('load from', at);
                }
                if (at >>> 28 === 2) {
                    if (contended)
                        cycles = bus.ram(index, at, cycles);
                    r[op & 7] = ram16[(at & 0x7ffff) >> 1];
                } else if (at >>> 24 === 0x10) {
                    cycles = bus.xip(index, at, cycles, 0);
                    r[op & 7] = flash16[(at & 0xffffff) >> 1];
                } else if (at >>> 0 < 0x4000) {
                    r[op & 7] = rom16[at >> 1];
                } else {
                    r[15] = from;
                    this.outside(cycles);
                    r[op & 7] = this.rp2040.readUint16(at >>> 0);
                    cycles += bus.peripheral(at);
                    live = false;
                }
                break;
            case 20:                                                // ADR
                r[op >> 8 & 7] = (pc + 2 & ~3) + ((op & 255) << 2);
                cycles++;
                break;
            case 21:                                                // ADD (SP)
                r[op >> 8 & 7] = r[13] + ((op & 255) << 2);
                cycles++;
                break;
            case 22:
            case 23: {
                const k = op >> 8 & 15;
                if (k === 0) {                                      // ADD, SUB (SP)
                    r[13] += op & 0x80 ? -((op & 127) << 2) : (op & 127) << 2;
                    cycles++;
                    break;
                }
                if (k === 2) {
                    x = r[op >> 3 & 7];
                    switch (op >> 6 & 3) {
                    case 0: x = x << 16 >> 16; break;               // SXTH
                    case 1: x = x << 24 >> 24; break;               // SXTB
                    case 2: x &= 0xffff; break;                     // UXTH
                    case 3: x &= 255; break;                        // UXTB
                    }
                    r[op & 7] = x;
                    cycles++;
                    break;
                }
                if (k === 4 || k === 5) {                           // PUSH
                    at = r[13] - 4 * (count[op & 255] + (k & 1));
                    if (at >>> 28 !== 2) {
                        live = null;
                        break;
                    }
                    r[13] = at;
                    for (i = 0; i < 9; i++)
                        if (op >> i & 1) {
                            cycles++;
                            if (contended)
                                cycles = bus.ram(index, at, cycles);
                            ram32[(at & 0x7ffff) >> 2] = i === 8 ? r[14] : r[i];
                            at += 4;
                        }
                    cycles++;
                    break;
                }
                if (k === 12 || k === 13) {                         // POP
                    at = r[13];
                    if (at >>> 28 !== 2) {
                        live = null;
                        break;
                    }
                    for (i = 0; i < 8; i++)
                        if (op >> i & 1) {
                            cycles++;
                            if (contended)
                                cycles = bus.ram(index, at, cycles);
                            r[i] = ram32[(at & 0x7ffff) >> 2];
                            at += 4;
                        }
                    cycles++;
                    if (k & 1) {
                        x = ram32[(at & 0x7ffff) >> 2];
                        r[13] = at + 4;
                        cycles += 3;
                        if (x >>> 28 === 15) {
                            this.cycles = cycles;
                            r[15] = pc;
                            this.N = nz < 0;
                            this.Z = nz === 0;
                            this.C = c === 1;
                            this.V = v === 1;
                            this.BXWritePC(x >>> 0);
                            this.instructions += done;
                            this.word = -1;
                            return;
                        }
                        pc = x & ~1;
                        word = -1;
                    } else {
                        r[13] = at;
                    }
                    break;
                }
                if (k === 10 && (op >> 6 & 3) !== 2) {
                    x = r[op >> 3 & 7];
                    if ((op >> 6 & 3) === 0)                        // REV
                        x = x << 24 | (x & 0xff00) << 8 | x >> 8 & 0xff00 | x >>> 24;
                    else if ((op >> 6 & 3) === 1)                   // REV16
                        x = (x & 0xff00ff) << 8 | x >>> 8 & 0xff00ff;
                    else                                            // REVSH
                        x = (x & 255) << 24 >> 16 | x >> 8 & 255;
                    r[op & 7] = x;
                    cycles++;
                    break;
                }
                if (op === 0xbf00) {                                // NOP
                    cycles++;
                    break;
                }
                if (op === 0xbf40) {                                // SEV
                    cycles++;
                    bus.event(cycles);
                    break;
                }
                live = null;                                        // CPS, BKPT, WFE ...: below
                break;
            }
            case 24:                                                // STM
                at = r[op >> 8 & 7];
                if (at >>> 28 !== 2) {
                    live = null;
                    break;
                }
                if (at & 3 || (at & 0x7ffff) >= 0x42000) {
                    r[15] = from;
                    this.fault('store multiple to', at);
                }
                cycles++;
                for (i = 0; i < 8; i++)
                    if (op >> i & 1) {
                        cycles++;
                        if (contended)
                            cycles = bus.ram(index, at, cycles);
                        ram32[(at & 0x7ffff) >> 2] = r[i];
                        at += 4;
                    }
                r[op >> 8 & 7] = at;
                break;
            case 25: {                                              // LDM
                at = r[op >> 8 & 7];
                const place = at >>> 28 === 2 ? ram32 : at >>> 24 === 0x10 ? flash32 : null;
                if (place === null) {
                    live = null;
                    break;
                }
                if (at & 3) {
                    r[15] = from;
                    this.fault('load multiple from', at);
                }
                cycles++;
                for (i = 0; i < 8; i++)
                    if (op >> i & 1) {
                        cycles++;
                        if (place === flash32)
                            cycles = bus.xip(index, at, cycles, 0);
                        else if (contended)
                            cycles = bus.ram(index, at, cycles);
                        r[i] = place[(at & (place === flash32 ? 0xffffff : 0x7ffff)) >> 2];
                        at += 4;
                    }
                if (!(op >> (op >> 8 & 7) & 1))
                    r[op >> 8 & 7] = at;
                break;
            }
            case 26:
            case 27: {                                              // B (with condition)
                let taken;
                switch (op >> 8 & 15) {
                case 0: taken = nz === 0; break;
                case 1: taken = nz !== 0; break;
                case 2: taken = c === 1; break;
                case 3: taken = c === 0; break;
                case 4: taken = nz < 0; break;
                case 5: taken = nz >= 0; break;
                case 6: taken = v === 1; break;
                case 7: taken = v === 0; break;
                case 8: taken = c === 1 && nz !== 0; break;
                case 9: taken = c === 0 || nz === 0; break;
                case 10: taken = (nz < 0) === (v === 1); break;
                case 11: taken = (nz < 0) !== (v === 1); break;
                case 12: taken = nz !== 0 && (nz < 0) === (v === 1); break;
                case 13: taken = nz === 0 || (nz < 0) !== (v === 1); break;
                default: live = null;                               // UDF, SVC
                }
                if (live === null)
                    break;
                cycles++;
                if (taken) {
                    pc = pc + 2 + (op << 24 >> 23) | 0;
                    cycles++;
                    word = -1;
                }
                break;
            }
            case 28:                                                // B
                pc = pc + 2 + (op << 21 >> 20) | 0;
                cycles += 2;
                word = -1;
                break;
            case 30: {
                const low = pc >>> 28 === 2 ? ram16[(pc & 0x7ffff) >> 1] : pc >>> 24 === 0x10 ? flash16[(pc & 0xffffff) >> 1] : rom16[pc >> 1];
                if ((low & 0xd000) !== 0xd000) {
                    live = null;                                    // MRS, MSR, DMB ...
                    break;
                }
                const s = op >> 10 & 1;                             // BL
                if (pc >>> 24 === 0x10 && word !== pc >> 2)
                    cycles = bus.xip(index, pc, cycles, 1);
                r[14] = pc + 2 | 1;
                pc = pc + 2 + (s * -0x1000000 | ((low >> 13 & 1) ^ s ^ 1) << 23 | ((low >> 11 & 1) ^ s ^ 1) << 22 | (op & 0x3ff) << 12 | (low & 0x7ff) << 1) | 0;
                cycles += 3;
                word = -1;
                break;
            }
            default:
                live = null;
            }

            if (live !== true) {
                if (live === null) {                                // all that is rare, by rp2040js
                    this.cycles = cycles;
                    r[15] = from;
                    this.N = nz < 0;
                    this.Z = nz === 0;
                    this.C = c === 1;
                    this.V = v === 1;
                    bus.enter(this);
                    super.executeInstruction();
                    this.instructions += done;
                    this.word = -1;
                    if (profile !== null)
                        profile[this.profile_at(from)] += this.cycles - began;
                    return;
                }
                if (op >> 11 === 12 || op >> 11 === 14 || op >> 11 === 16 || op >> 11 === 18 || (op >> 11 === 10 && i > 0)) {
                    r[15] = from;                                   // a store to a peripheral
                    if (at >>> 28 === 2 || at >>> 28 === 1 && at >>> 24 < 0x14 || at >>> 0 < 0x4000)
                        this.fault('store to', at);
                    this.outside(cycles);
                    if (i === 4)
                        this.rp2040.writeUint32(at >>> 0, x >>> 0);
                    else if (i === 2)
                        this.rp2040.writeUint16(at >>> 0, x & 0xffff);
                    else
                        this.rp2040.writeUint8(at >>> 0, x & 255);
                    cycles += bus.peripheral(at);
                }
            }
            if (profile !== null) {
                const where = this.profile_at(from);
                profile[where] += cycles - began;
                this.executed[where]++;
                this.lost[where] += bus.lost;
            }
        }
        this.cycles = cycles;
        r[15] = pc;
        this.N = nz < 0;
        this.Z = nz === 0;
        this.C = c === 1;
        this.V = v === 1;
        this.word = word;
        this.instructions += done;
    }

    // Flash first, then RAM; halfwords.
    profile_at(pc) {
        return pc >>> 28 === 2 ? 0x800000 + ((pc & 0x7ffff) >> 1) : (pc & 0xffffff) >> 1;
    }

    start_profile() {
        this.profile = new Float64Array(0x800000 + 0x21000);
        this.executed = new Float64Array(0x800000 + 0x21000);
        this.lost = new Float64Array(0x800000 + 0x21000);       // cycles for code that was not in the flash cache
    }
};
