// SPDX-License-Identifier: MIT
// game.js - the game in a page: its loop, clock, keys and canvas. display.c has the other side.
"use strict";
const at = id => document.getElementById(id), canvas = at("picture");
const KEYS = { ArrowLeft: 4, a: 4, ArrowRight: 8, d: 8, ArrowDown: 2, s: 2, " ": 2, Enter: 32, x: 16 };
const keysDown = new Set(), pointers = new Map();       // names of keys; bits that fingers hold
let w, said = "", before = 0, time = 0, shown = 0, ticket = 0, picture, canvasSize = "";
let counted = { since: 0, frames: 0, spent: 0 };

function fatal(text) {
    cancelAnimationFrame(ticket);
    at("fatal").textContent = text;
    at("fatal").hidden = false;
    for (const e of [canvas, at("pads"), at("rate"), at("keys")]) e.hidden = true;
    document.body.dataset.state = "failed";
}

const imports = { platform: {
    print: from => {
        const bytes = new Uint8Array(w.memory.buffer);
        said += new TextDecoder().decode(bytes.slice(from, bytes.indexOf(0, from)));
    },
    clock: () => Math.round(performance.now() * 1000) >>> 0 } };

// What the program prints, given these arguments: replay("game check page 200").
function replay(line) {
    said = "";
    new Uint8Array(w.memory.buffer).set(new TextEncoder().encode(line + "\0"), w.wasm_command_line());
    w.wasm_main();
    return said;
}

// ------------------------------------------------------------------ keys

function held() {
    let bits = 0;
    for (const name of keysDown) bits |= KEYS[name];
    for (const bit of pointers.values()) bits |= bit;
    for (const b of document.querySelectorAll("[data-key]")) b.classList.toggle("held", (bits & +b.dataset.key) !== 0);
    return bits;
}

function letGo() {
    keysDown.clear();
    pointers.clear();
}

const nameOf = event => event.key.length === 1 ? event.key.toLowerCase() : event.key;

addEventListener("keydown", event => {
    const name = nameOf(event);
    if (!(name in KEYS) || event.ctrlKey || event.altKey || event.metaKey || (event.target.dataset.key && (name === "Enter" || name === " "))) return;
    keysDown.add(name);
    event.preventDefault();
});
addEventListener("keyup", event => keysDown.delete(nameOf(event)));
addEventListener("blur", letGo);

// Buttons hold their key; a finger on the picture steers to its side.
function bitOf(event) {
    const button = event.target.closest("[data-key]");
    if (button) return +button.dataset.key;
    const box = canvas.getBoundingClientRect();
    return event.clientX < box.left + box.width / 2 ? 4 : 8;
}

for (const e of [canvas, at("pads")]) {
    e.addEventListener("pointerdown", event => {
        if (e !== canvas && !event.target.dataset.key) return;
        pointers.set(event.pointerId, bitOf(event));
        event.preventDefault();
    });
    e.addEventListener("contextmenu", event => event.preventDefault());
}
for (const type of ["pointerup", "pointercancel"]) addEventListener(type, event => pointers.delete(event.pointerId));
// A button that is pressed by a keyboard is held for a moment.
at("pads").addEventListener("click", event => {
    if (event.detail !== 0 || !event.target.dataset.key) return;
    pointers.set("key", +event.target.dataset.key);
    setTimeout(() => pointers.delete("key"), 150);
});

// ------------------------------------------------------------------ the sound

const HZ = 15000;                                       // platform/sound.h
let audio = null, heard = 0;

at("sound").addEventListener("click", () => {
    if (audio === null) audio = new AudioContext();
    else if (audio.state === "running") audio.suspend();
    else audio.resume();
    at("sound").classList.toggle("held");
});

// What a turn sounds like comes after what is heard already; what would come late is left out.
function hear() {
    const count = w.wasm_take_samples();
    if (count === 0 || audio === null || audio.state !== "running") return;
    const start = Math.max(heard, audio.currentTime + 0.02);
    if (start > audio.currentTime + 0.3) return;
    const buffer = audio.createBuffer(1, count, HZ), source = audio.createBufferSource();
    buffer.getChannelData(0).set(Float32Array.from(new Int16Array(w.memory.buffer, w.wasm_samples(), count), s => s / 65536));
    source.buffer = buffer;
    source.connect(audio.destination);
    source.start(start);
    heard = start + count / HZ;
}

// ------------------------------------------------------------------ the picture

// As large as fits, each pixel a square of whole pixels of the screen.
function fit() {
    const dots = devicePixelRatio || 1, below = at("pads").offsetHeight + at("rate").offsetHeight + at("keys").offsetHeight + 48;
    const room = Math.min((innerWidth - 16) * dots / canvas.width, Math.max(innerHeight - below, 120) * dots / canvas.height);
    const zoom = room >= 1 ? Math.floor(room) : room, size = canvas.width * zoom / dots + "px";
    if (size === canvasSize) return;
    canvas.style.width = canvasSize = size;
    canvas.style.height = canvas.height * zoom / dots + "px";
}

function count(now, spent) {
    counted.frames++;
    counted.spent += spent;
    const gone = now - counted.since;
    if (gone < 1000) return;
    at("rate").textContent = (counted.frames * 1000 / gone).toFixed(1) + " frames per second, " + (counted.spent / counted.frames).toFixed(1)
        + " ms each, " + canvas.width + "x" + canvas.height + " pixels";
    counted = { since: now, frames: 0, spent: 0 };
}

function turn(now) {
    const begun = performance.now();
    time += Math.min(Math.max(now - before, 0), 1000);
    before = now;
    try {
        w.wasm_set(Math.floor(time), held());
        said = "";
        const result = w.game_turn();
        hear();
        if (result !== 0) return fatal("The race has stopped: error " + result + " " + said);
    } catch (error) {
        return fatal("The race has stopped: " + (error && error.message || error));
    }
    if (w.wasm_shown() !== shown) {
        shown = w.wasm_shown();
        canvas.getContext("2d").putImageData(picture, 0, 0);
        count(now, performance.now() - begun);
    }
    fit();
    ticket = requestAnimationFrame(turn);
}

// Nothing goes on while nobody sees it.
function runOrPause() {
    letGo();
    cancelAnimationFrame(ticket);
    document.body.dataset.state = document.hidden ? "paused" : "runs";
    if (document.hidden) {
        at("rate").textContent = "paused";
        return;
    }
    before = counted.since = performance.now();
    counted.frames = counted.spent = 0;
    ticket = requestAnimationFrame(turn);
}

async function begin() {
    if (typeof WebAssembly !== "object")
        throw new Error("this browser has no WebAssembly, or it is switched off. Any since 2018 has it; or play it without one: make game");
    const text = id => at(id).textContent.trim();
    if (text("unlzma") === "" || text("game") === "") throw new Error("the program is missing in this copy of the page: make web writes a whole one");
    let files;
    try {
        files = await filesOf(text("unlzma"), text("game"));
        w = (await WebAssembly.instantiate(files[0], imports)).instance.exports;
    } catch (error) {
        throw new Error("the program in this copy of the page is damaged (" + error.message + "): make web writes a whole one");
    }
    w.wasm_set(0, 0);
    if (w.game_open(0) !== 0) throw new Error(said);
    canvas.width = w.wasm_width();
    canvas.height = w.wasm_height();
    picture = new ImageData(new Uint8ClampedArray(w.memory.buffer, w.wasm_picture(), canvas.width * canvas.height * 4), canvas.width, canvas.height);
    document.addEventListener("visibilitychange", runOrPause);
    runOrPause();
}

begin().catch(error => fatal("The race does not start: " + (error && error.message || error)));
