// SPDX-License-Identifier: MIT
// selftest.mjs - the interpreter of core.mjs against that of rp2040js, instruction by instruction, on what core 0 does.
import { Fault } from './chip.mjs';

// rp2040js's core cannot be run beside ours on one memory: it gets the registers, and its stores go into a list.
export function self_test(chip, wanted) {
    const [core] = chip.cores, { mcu } = chip;
    const shadow = { readUint32: a => mcu.readUint32(a), readUint16: a => mcu.readUint16(a), readUint8: a => mcu.readUint8(a),
        logger: mcu.logger, stores: [] };
    for (const bytes of [4, 2, 1])
        shadow[`writeUint${8 * bytes}`] = (address, value) => shadow.stores.push([address >>> 0, bytes, value]);
    const plain = new chip.Plain(shadow);
    let compared = 0, of_memory = 0;
    const step = () => {
        const pc = core.signed[15], op = mcu.readUint16(pc);
        if (core.interruptsUpdated || core.IPSR !== 0 || !is_plain(core, op)) {
            core.run(core.cycles + 1);
            return;
        }
        plain.registers.set(core.registers);
        Object.assign(plain, { N: core.N, Z: core.Z, C: core.C, V: core.V, interruptsUpdated: false });
        shadow.stores.length = 0;
        plain.executeInstruction();
        core.run(core.cycles + 1);
        const same = plain.registers.every((value, i) => value === core.registers[i]) &&
            [plain.N, plain.Z, plain.C, plain.V].join() === [core.N, core.Z, core.C, core.V].join() &&
            shadow.stores.every(([address, bytes, value]) => ((mcu[`readUint${8 * bytes}`](address) ^ value) & (bytes === 4 ? -1 : (1 << 8 * bytes) - 1)) === 0);
        if (!same)
            throw new Fault(`the interpreters differ at ${(pc >>> 0).toString(16)}, instruction ${op.toString(16)}`);
        of_memory += shadow.stores.length;
        compared++;
    };
    chip.run(() => {
        for (let i = 0; i < 1000 && compared < wanted && !core.waiting; i++)
            step();
        return compared >= wanted;
    }, 1);
    console.log(`${compared} instructions alike, ${of_memory} words stored`);
}

// Without peripherals, which answer once, and without shifts by 32 and more, carries and overflows of which rp2040js gets wrong.
function is_plain(core, op) {
    const r = core.signed, base = op >> 12;
    if (base === 0xb && (op >> 9 & 7) !== 2 && (op >> 9 & 7) !== 6 && (op >> 8 & 15) > 2)
        return false;
    if (base === 0xd && (op >> 8 & 15) > 13)
        return false;
    if (op >> 11 > 28 && (op >> 11 !== 30 || (core.rp2040.readUint16(core.registers[15] + 2) & 0xd000) !== 0xd000))
        return false;                           // of the wide ones only BL
    if (op >> 10 === 16 && [2, 3, 4, 5, 6, 7].includes(op >> 6 & 15))
        return false;
    const of_memory = base >= 5 && base <= 9 || base === 12;
    const at = base === 5 ? r[op >> 3 & 7] + r[op >> 6 & 7] : base === 9 ? r[13] : base === 12 ? r[op >> 8 & 7] : r[op >> 3 & 7];
    return !of_memory || at >>> 28 === 2 || at >>> 24 === 0x10;
}
