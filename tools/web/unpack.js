// SPDX-License-Identifier: MIT
// unpack.js - what pack.c and xz have packed: text to bytes, and the files in them. In the page and in workers.

// The number of bytes, a blank, and pairs of characters that hold 13 bits, or 14.
function bytesOfText(text) {
    const value = new Uint8Array(128), out = new Uint8Array(parseInt(text));
    let count = 0, at = 0, hold = 0, bits = 0;
    for (let c = 33; c < 127; c++)
        if (c !== 34 && c !== 92 && c !== 60) value[c] = count++;
    for (let i = text.indexOf(" ") + 1; i + 1 < text.length; i += 2) {
        const v = value[text.charCodeAt(i)] + value[text.charCodeAt(i + 1)] * 91;
        hold |= v << bits;
        bits += (v & 8191) > 88 ? 13 : 14;
        for (; bits >= 8; bits -= 8, hold >>>= 8) out[at++] = hold & 255;
    }
    return out;
}

// The files that `pack join` has joined and xz has packed; `unlzma` is the module that unpacks them. All as text.
async function filesOf(unlzma, text) {
    const { instance } = await WebAssembly.instantiate(bytesOfText(unlzma)), w = instance.exports, packed = bytesOfText(text), out = [];
    new Uint8Array(w.memory.buffer, w.unlzma_input()).set(packed);
    const size = w.unlzma(packed.length);
    if (size < 0) throw new Error("the page is damaged");
    const all = new Uint8Array(w.memory.buffer, w.unlzma_output(), size);
    for (let at = 0; at < size;) {
        let length = 0, shift = 0, b;
        do { b = all[at++]; length |= (b & 127) << shift; shift += 7; } while (b & 128);
        out.push(all.slice(at, at += length));
    }
    return out;
}
