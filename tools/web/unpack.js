// SPDX-License-Identifier: MIT
// unpack.js - what pack.c has packed: text to bytes, zlib, and the second module from the first. Used in workers.

// Two characters hold 13 bits, or 14.
function bytesOfText(text) {
    const value = new Uint8Array(128);
    let count = 0;
    for (let c = 33; c < 127; c++)
        if (c !== 34 && c !== 92 && c !== 60) value[c] = count++;
    const out = new Uint8Array(Math.ceil(text.length * 7 / 8) + 2);
    let at = 0, hold = 0, bits = 0;
    for (let i = 0; i + 1 < text.length; i += 2) {
        const v = value[text.charCodeAt(i)] + value[text.charCodeAt(i + 1)] * 91;
        hold |= v << bits;
        bits += (v & 8191) > 88 ? 13 : 14;
        for (; bits >= 8; bits -= 8, hold >>>= 8) out[at++] = hold & 255;
    }
    return out;
}

// RFC 1950 and 1951. Canonical codes: `count` of each length, symbols in their order.
function inflate(data, start, size) {
    const out = new Uint8Array(size);
    let at = start + 2, hold = 0, held = 0, n = 0;
    const bits = need => {
        while (held < need) { hold |= data[at++] << held; held += 8; }
        const v = hold & ((1 << need) - 1);
        hold >>>= need; held -= need;
        return v;
    };
    const codes = lengths => {
        const count = new Uint16Array(16), first = new Uint16Array(16), symbol = new Uint16Array(lengths.length);
        for (const l of lengths) count[l]++;
        count[0] = 0;
        for (let l = 1; l < 16; l++) first[l] = first[l - 1] + count[l - 1];
        for (let s = 0; s < lengths.length; s++) if (lengths[s]) symbol[first[lengths[s]]++] = s;
        return { count, symbol };
    };
    const read = h => {
        let code = 0, first = 0, index = 0;
        for (let l = 1; l < 16; l++) {
            if (held === 0) { hold = data[at++]; held = 8; }
            code |= hold & 1; hold >>>= 1; held--;
            const c = h.count[l];
            if (code - c < first) return h.symbol[index + code - first];
            index += c; first = (first + c) << 1; code <<= 1;
        }
        throw new Error("the page is damaged");
    };
    const order = [16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15];
    const lengthOf = [3, 4, 5, 6, 7, 8, 9, 10, 11, 13, 15, 17, 19, 23, 27, 31, 35, 43, 51, 59, 67, 83, 99, 115, 131, 163, 195, 227, 258];
    const lengthBits = [0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0];
    for (let last = 0; !last;) {
        last = bits(1);
        const kind = bits(2);
        if (kind === 0) {
            hold = held = 0;
            const length = data[at] | data[at + 1] << 8;
            out.set(data.subarray(at + 4, at + 4 + length), n);
            at += 4 + length; n += length;
            continue;
        }
        let literals, distances;
        if (kind === 1) {
            const l = new Uint8Array(288).fill(8);
            l.fill(9, 144, 256); l.fill(7, 256, 280);
            literals = codes(l);
            distances = codes(new Uint8Array(30).fill(5));
        } else {
            const nl = bits(5) + 257, nd = bits(5) + 1, nc = bits(4) + 4, l = new Uint8Array(19), all = new Uint8Array(nl + nd);
            for (let i = 0; i < nc; i++) l[order[i]] = bits(3);
            const h = codes(l);
            for (let i = 0; i < nl + nd;) {
                const s = read(h);
                if (s < 16) { all[i++] = s; continue; }
                const v = s === 16 ? all[i - 1] : 0, times = s === 16 ? 3 + bits(2) : s === 17 ? 3 + bits(3) : 11 + bits(7);
                all.fill(v, i, i + times);
                i += times;
            }
            literals = codes(all.subarray(0, nl));
            distances = codes(all.subarray(nl));
        }
        for (;;) {
            const s = read(literals);
            if (s < 256) { out[n++] = s; continue; }
            if (s === 256) break;
            const length = lengthOf[s - 257] + bits(lengthBits[s - 257]), d = read(distances);
            const distance = d < 4 ? d + 1 : ((2 + (d & 1)) << (d >> 1) - 1) + 1 + bits((d >> 1) - 1);
            for (let i = 0; i < length; i++, n++) out[n] = out[n - distance];
        }
    }
    return out;
}

function unpacked(text) {
    const packed = bytesOfText(text), size = packed[0] | packed[1] << 8 | packed[2] << 16 | packed[3] << 24;
    const raw = inflate(packed, 4, size);
    let at = 0;
    const number = () => {
        let v = 0, shift = 0, b;
        do { b = raw[at++]; v |= (b & 127) << shift; shift += 7; } while (b & 128);
        return v;
    };
    return { number, part: n => raw.subarray(at, at += n), more: end => at < (end || raw.length), at: () => at };
}

// The files of @text, as text.
function textsOf(text) {
    const u = unpacked(text), out = [];
    while (u.more()) out.push(new TextDecoder().decode(u.part(u.number())));
    return out;
}

// The module with SIMD where `simd`, else the one without.
function moduleBytes(text, simd) {
    const u = unpacked(text), first = u.part(u.number());
    if (!simd) return first;
    const end = u.number() + u.at(), out = [];
    while (u.more(end)) {
        out.push(u.part(u.number()));
        const count = u.number(), from = u.number();
        out.push(first.subarray(from, from + count));
    }
    const all = new Uint8Array(out.reduce((sum, part) => sum + part.length, 0));
    let n = 0;
    for (const part of out) { all.set(part, n); n += part.length; }
    return all;
}
