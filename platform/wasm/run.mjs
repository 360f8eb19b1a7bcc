// SPDX-License-Identifier: MIT
// run.mjs - runs a program for TARGET=wasm in node:
//
//     node platform/wasm/run.mjs PROGRAM.wasm [ARGUMENT...]
import { readFileSync } from "node:fs";

const [program, ...words] = process.argv.slice(2);
let text = "";
const decoder = new TextDecoder();
const imports = { platform: {
    print: at => {
        const bytes = new Uint8Array(w.memory.buffer);
        text += decoder.decode(bytes.subarray(at, bytes.indexOf(0, at)));
    },
    clock: () => Math.round(performance.now() * 1000) >>> 0 } };
const { instance } = await WebAssembly.instantiate(readFileSync(program), imports), w = instance.exports;
const line = new TextEncoder().encode([program.replace(/.*\//, ""), ...words].join(" "));
if (line.length >= w.wasm_command_line_bytes()) throw new Error("the command line is too long");
new Uint8Array(w.memory.buffer).set(line, w.wasm_command_line());
try {
    process.exitCode = w.wasm_main();
} finally {
    process.stdout.write(text);
}
