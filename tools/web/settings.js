// SPDX-License-Identifier: MIT
// settings.js - what there is to choose, and what has been chosen: the address and the command line are made of it.

const $ = id => document.getElementById(id);

// METHODS, of tools/scenes/methods.c, comes before this.
const methodNamed = name => METHODS.findIndex(m => m.name === name);
const QUALITIES = ["sketch", "draft", "balanced", "fine"];
const RATES = [10, 15, 30, 60];
const PANELS = [                        // those of boards are added when the module has told them
    { name: "pocket", label: "240\u00d7240 LCD, RGB565", shell: "pocket", words: ["--size", "240x240", "--format", "rgb565"], board: -1 },
    { name: "grey", label: "128\u00d764 OLED of 16 greys, L4", shell: "board", words: ["--size", "128x64", "--format", "l4"], board: -1 },
];
const SHELLS = { oled: "board", rp2040: "pocket", esp32s3: "pocket", esp32c6: "pocket", round: "watch", gba: "gba", memlcd: "memlcd", fb320: "linux" };
const LABELS = { oled: "128\u00d764 OLED, 1 bit", rp2040: "RP2040 with 240\u00d7240 LCD", esp32s3: "ESP32-S3 with 240\u00d7240 LCD", esp32c6: "ESP32-C6 with 240\u00d7240 LCD", round: "Round 240\u00d7240 LCD", gba: "Game Boy Advance, 240\u00d7160",
    memlcd: "400\u00d7240 memory LCD, 1 bit", fb320: "320\u00d7240 framebuffer" };
const SCENES = [{ name: "race", label: "Racing car, chased" }, { name: "drone", label: "Drone, fixed camera" }];
const DEFAULTS = { scene: "race", panel: "pocket", clip: 0, spin: 1, shutter: 180, method: methodNamed("auto"), quality: 2, fps: 15, split: 50, paused: false, frame: 0, light: "linear" };

let S = { ...DEFAULTS };
// Quality of methods that have three, without a sketch: its samples are a draft's.
const sampleQuality = quality => Math.max(1, quality);
const samplesOf = (method, quality) => method.samples[sampleQuality(quality) - 1];
let model = null;                       // { name, files } of what has been dropped
let scene = { period: 60, clips: [], width: 240, height: 240 };
let turned = false, isStill = false;

function readAddress() {
    const given = new URLSearchParams(location.hash.slice(1));
    const pick = (key, list) => list.includes(given.get(key)) ? given.get(key) : DEFAULTS[key];
    const whole = (key, low, high) => /^\d{1,6}$/.test(given.get(key) || "") ? Math.min(high, Math.max(low, +given.get(key))) : DEFAULTS[key];
    const index = (key, list) => Math.max(0, given.has(key) && list.includes(given.get(key)) ? list.indexOf(given.get(key)) : DEFAULTS[key]);
    S = { scene: pick("scene", SCENES.map(s => s.name)), panel: pick("panel", PANELS.map(p => p.name)), clip: whole("clip", 0, 999), spin: whole("spin", 0, 1),
        shutter: whole("shutter", 0, 360), method: index("method", METHODS.map(m => m.name)), quality: index("quality", QUALITIES),
        fps: RATES.includes(+given.get("fps")) ? +given.get("fps") : DEFAULTS.fps, split: whole("split", 0, 100),
        paused: given.get("paused") === "1", frame: whole("frame", 0, 99999), light: pick("light", ["linear", "encoded"]) };
}

function writeAddress() {
    const out = [];
    const note = (key, value) => { if (S[key] !== DEFAULTS[key]) out.push(key + "=" + value); };
    if (S.scene !== "file") note("scene", S.scene);
    note("panel", S.panel); note("clip", S.clip); note("spin", S.spin); note("shutter", S.shutter); note("method", METHODS[S.method].name);
    note("quality", QUALITIES[S.quality]); note("fps", S.fps); note("split", S.split); note("light", S.light);
    if (S.paused) out.push("paused=1", "frame=" + S.frame);
    const hash = out.length ? "#" + out.join("&") : "";
    if (hash !== location.hash) {
        try { history.replaceState(null, "", hash || location.pathname + location.search); } catch (e) { location.hash = hash; }
    }
}

const panel = () => PANELS.find(p => p.name === S.panel) || PANELS[0];
const sceneWord = () => S.scene === "file" && model ? model.main : "builtin:demo/" + S.scene;

// Options of `smear render` for the settings; the scene comes last.
function words() {
    const method = METHODS[S.method], out = [...panel().words, "--fps", String(S.fps), "--shutter", String(S.shutter), "--method", method.name];
    if (method.name === "auto") out.push("--quality", QUALITIES[S.quality]);
    if (samplesOf(method, S.quality)) out.push("--samples", String(samplesOf(method, S.quality)));
    if (S.light !== "linear") out.push("--light", S.light);
    if (S.scene === "file") {
        out.push("--loop");
        if (panel().words.some(w => w.startsWith("rgb"))) out.push("--clear", "28324a");
        if (S.clip > 0) out.push("--clip", String(S.clip));
    }
    return [...out, "--", sceneWord()];
}

// What has to be opened anew when it changes: the scene, its clip, the picture's shape.
const openKey = () => [S.scene, model && model.serial, S.clip, panel().words.join(" ")].join("|");
