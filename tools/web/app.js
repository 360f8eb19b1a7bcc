// SPDX-License-Identifier: MIT
// app.js - the page: settings, engines (workers with the module) that draw frames, and what shows them.
//
//     settings    what the user has chosen; the address and the command line are made of them
//     engines     draw frames, ahead of the one shown; frames are kept until a setting changes
//     player      shows frame after frame at their pace, or as fast as they come the first time
//     chart, model, film, keys

"use strict";
const $ = id => document.getElementById(id);

// ------------------------------------------------------------------ settings

// samples: of each quality; 0: the method has none to choose.
const METHODS = [
    { name: "none", label: "sharp", hint: "One instant. What every small renderer shows.", samples: [0, 0, 0] },
    { name: "accumulate", label: "accumulate", hint: "The mean of whole sharp frames: what you would write yourself.", samples: [4, 8, 16] },
    { name: "reconstruct", label: "reconstruct", hint: "The filter of GPU engines: one sharp frame, smeared along its motion.", samples: [4, 8, 16] },
    { name: "camera", label: "camera", hint: "The camera's motion alone, told from depth: nothing is done per vertex.", samples: [4, 8, 16] },
    { name: "pingpong", label: "ping-pong", hint: "Few taps, twice over: the second round smooths the first.", samples: [0, 0, 0] },
    { name: "half", label: "half", hint: "reconstruct at half the size, mixed in by the amount of motion.", samples: [4, 8, 16] },
    { name: "object", label: "object", hint: "Each moving object along its one velocity, over the still scene: long streaks cost no more.", samples: [0, 0, 0] },
    { name: "layered", label: "layered", hint: "What moves, by velocities of its pixels, over the still scene.", samples: [4, 8, 16] },
    { name: "subframes", label: "subframes", hint: "Only tiles in which something moves are drawn at several instants.", samples: [8, 16, 32] },
    { name: "timemask", label: "timemask", hint: "For each pixel, the time each triangle covers it, in closed form.", samples: [8, 16, 32] },
    { name: "auto", label: "auto", hint: "Each tile gets the cheapest method that is good enough.", samples: [0, 0, 0] },
];
const methodNamed = name => METHODS.findIndex(m => m.name === name);
const QUALITIES = ["draft", "balanced", "fine"];
const RATES = [10, 15, 30, 60];
const PANELS = [                        // those of boards are added when the module has told them
    { name: "pocket", label: "240\u00d7240 LCD, RGB565", shell: "pocket", words: ["--size", "240x240", "--format", "rgb565"], board: -1 },
    { name: "grey", label: "128\u00d764 OLED of 16 greys, L4", shell: "board", words: ["--size", "128x64", "--format", "l4"], board: -1 },
];
const SHELLS = { oled: "board", rp2040: "pocket", round: "watch", gba: "gba", memlcd: "memlcd", fb320: "linux" };
const LABELS = { oled: "128\u00d764 OLED, 1 bit", rp2040: "RP2040 with 240\u00d7240 LCD", round: "Round 240\u00d7240 LCD", gba: "Game Boy Advance, 240\u00d7160",
    memlcd: "400\u00d7240 memory LCD, 1 bit", fb320: "320\u00d7240 framebuffer" };
const SCENES = [{ name: "race", label: "Racing car, chased" }, { name: "drone", label: "Drone, fixed camera" }];
const DEFAULTS = { scene: "race", panel: "pocket", clip: 0, spin: 1, shutter: 180, method: methodNamed("auto"), quality: 1, fps: 15, split: 50, paused: false, frame: 0, light: "linear" };

let S = { ...DEFAULTS };
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
    if (method.samples[S.quality]) out.push("--samples", String(method.samples[S.quality]));
    if (S.light !== "linear") out.push("--light", S.light);
    if (S.scene === "file") {
        out.push("--loop");
        if (S.clip > 0) out.push("--clip", String(S.clip));
    }
    return [...out, "--", sceneWord()];
}

// What has to be opened anew when it changes: the scene, its clip, the picture's shape.
const openKey = () => [S.scene, model && model.serial, S.clip, panel().words.join(" ")].join("|");

// ------------------------------------------------------------------ engines

const SIMD_PROBE = [0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11];
let hasSimd = false, compiled = null, workerUrl = null;

class Engine {
    constructor() {
        this.serial = 0;
        this.begin();
    }
    begin() {
        this.waiting = new Map();
        this.busy = 0;
        this.openKey = "";
        this.spin = 0;
        this.epoch = -1;
        this.worker = new Worker(workerUrl);
        this.worker.onmessage = e => this.take(e.data);
        this.worker.onerror = e => { e.preventDefault(); this.die(e.message || "the worker stopped"); };
        const first = compiled ? { module: compiled } : { unlzma: packed("unlzma"), text: packed("modules"), simd: hasSimd };
        this.started = this.ask("start", first, 20000).then(a => {
            if (a.module) compiled = a.module;
            return a;
        });
    }
    ask(todo, message, limit, progress) {
        return new Promise(resolve => {
            const id = ++this.serial, entry = { resolve, progress };
            this.waiting.set(id, entry);
            this.busy++;
            if (limit)
                entry.timer = setTimeout(() => this.die("this takes too long (more than " + limit / 1000 + " s)"), limit);
            this.worker.postMessage({ ...message, todo, id });
        });
    }
    take(answer) {
        const entry = this.waiting.get(answer.id);
        if (!entry) return;
        if (answer.progress !== undefined) { entry.progress(answer.progress); return; }
        this.waiting.delete(answer.id);
        this.busy--;
        clearTimeout(entry.timer);
        if (answer.dead) { this.die(answer.err); }
        entry.resolve(answer);
    }
    // Everything that was asked fails, and a new worker begins.
    die(why) {
        this.worker.terminate();
        const lost = [...this.waiting.values()];
        this.begin();
        for (const entry of lost) {
            clearTimeout(entry.timer);
            entry.resolve({ status: 1, dead: true, err: "smear: the module stopped: " + why + "\n", out: "" });
        }
    }
}

let engines = [];
let epoch = 0;                          // of settings: frames of an older one are thrown away
const poses = { frame: 0, yaw: 0, pitch: 0, factor: 1 };      // frame: at which the camera looks at what it is turned about

const clean = text => text.trim().replace(/^smear: (warning: )?/gm, "");

// What stands still is put on a turntable: a round in two seconds.
const spinOf = scene => S.scene === "file" && S.spin && scene.period === 0 ? Math.PI : 0;

// Brings an engine to the present settings. Resolves to its answer.
async function tune(engine) {
    await engine.started;
    const wanted = epoch, key = openKey(), opens = engine.openKey !== key;
    const message = { words: words(), board: panel().board, files: S.scene === "file" && model ? model.files : [] };
    const answer = await engine.ask(opens ? "open" : "change", message, 30000);
    if (answer.status === 0) {
        engine.openKey = key;
        const spin = spinOf(answer.scene);
        if (spin) answer.scene.period = 2 * S.fps;
        if (engine.spin !== spin || (opens && (turned || spin)))
            await engine.ask("turn", { ...poses, spin, straight: true });
        engine.spin = spin;
        engine.epoch = wanted;
    }
    return answer;
}

// ------------------------------------------------------------------ frames

const frames = new Map();               // number -> { main, left, stats, width, height }
const inFlight = new Set();
const MOST_BYTES = 192 << 20;
let bytesKept = 0, changing = null, isFirst = true, lastGood = null;

function forget() {
    frames.clear();
    inFlight.clear();
    bytesKept = 0;
}

const period = () => Math.max(1, scene.period);
const ahead = (n, from) => (n - from + period()) % period();

function keep(answer) {
    const size = answer.width * answer.height * 8;
    frames.set(answer.frame, { ...answer, size });
    bytesKept += size;
    while (bytesKept > MOST_BYTES && frames.size > 2) {
        let worst = -1;
        for (const n of frames.keys()) if (worst < 0 || ahead(n, S.frame) > ahead(worst, S.frame)) worst = n;
        bytesKept -= frames.get(worst).size;
        frames.delete(worst);
    }
}

const roomFor = () => Math.floor(MOST_BYTES / (scene.width * scene.height * 8)) - 1;

function nextMissing() {
    const room = Math.min(period(), roomFor());
    for (let i = 0; i < room; i++) {
        const n = (S.frame + i) % period();
        if (!frames.has(n) && !inFlight.has(n)) return n;
        if (S.paused && i >= 2) return -1;
    }
    return -1;
}

async function drawOn(engine, n) {
    const wanted = epoch;
    inFlight.add(n);
    const answer = await engine.ask("draw", { frame: n }, 60000);
    if (wanted !== epoch) { pump(); return; }
    inFlight.delete(n);
    if (answer.status === 0) {
        keep(answer);
        lastGood = { ...S, model };
        lighten(answer.stats.us);
        if (n === S.frame) show();
        pump();
    } else if (answer.dead) {
        complain($("trouble"), clean(answer.err));
        change();
    } else {
        complain($("trouble"), clean(answer.err));
        if (frames.size === 0) refuse();
    }
}

// A slow machine begins with the lighter scene, unless the visitor has chosen one.
const firstTimes = [];
let mayLighten = false;
function lighten(us) {
    if (!mayLighten || firstTimes.push(us) < 5) return;
    mayLighten = false;
    if (Math.min(...firstTimes) > 60000) set({ scene: "drone", frame: 0 });
}

// Gives every idle engine something to draw.
function pump() {
    if (changing) return;
    for (const engine of engines) {
        if (engine.busy > 0) continue;
        if (engine.epoch !== epoch) {
            tune(engine).then(answer => { if (answer.status === 0) pump(); });
            continue;
        }
        const n = nextMissing();
        if (n < 0) return;
        drawOn(engine, n);
    }
}

// Settings have changed. The first engine says whether they go together; else the last good ones come back.
function change() {
    epoch++;
    forget();
    showSettings();
    if (changing) { changing.again = true; return; }
    changing = { again: false };
    run();
    async function run() {
        do {
            changing.again = false;
            const answer = await tune(engines[0]);
            if (changing.again) continue;
            if (answer.status !== 0) {
                complain($("trouble"), clean(answer.err));
                changing = null;
                refuse();
                return;
            }
            scene = answer.scene;
            if (answer.err) complain($("trouble"), clean(answer.err));
        } while (changing.again);
        changing = null;
        if (S.frame >= period()) S.frame = 0;
        showScene();
        pump();
    }
}

// Back to what has drawn a frame last.
function refuse() {
    if (!lastGood) { fatal("The module does not start: " + $("trouble").textContent); return; }
    const last = lastGood;
    lastGood = null;
    S = { ...S, ...last, frame: S.frame, paused: S.paused };
    model = last.model;
    delete S.model;
    change();
}

function set(changes) {
    mayLighten = false;
    $("trouble").textContent = "";
    Object.assign(S, changes);
    change();
}

function complain(where, text) {
    where.textContent = text;
}

// ------------------------------------------------------------------ the screen

const contexts = { main: $("right").getContext("2d"), left: $("left").getContext("2d") };
let shownFrame = null, firstFrameMs = 0;

function fit() {
    const screen = $("screen"), w = scene.width, h = scene.height, ratio = window.devicePixelRatio || 1;
    const around = e => 2 * parseFloat(getComputedStyle(e).paddingLeft);
    const room = $("device").parentElement.clientWidth - around($("device")) - around(screen.parentElement);
    const most = Math.min(room, 480, 480 * w / h);
    const zoom = Math.max(1, Math.floor(most * ratio / w)) / ratio;         // whole pixels of the display
    const width = Math.min(w * zoom, most >= w / ratio ? w * zoom : most);
    screen.style.width = width + "px";
    screen.style.height = width * h / w + "px";
    screen.classList.toggle("round", panel().name === "round");
}

function paint(context, bytes, f) {
    const canvas = context.canvas;
    if (canvas.width !== f.width || canvas.height !== f.height) { canvas.width = f.width; canvas.height = f.height; }
    context.putImageData(new ImageData(new Uint8ClampedArray(bytes), f.width, f.height), 0, 0);
}

function show() {
    const f = frames.get(S.frame);
    if (!f) return false;
    paint(contexts.main, f.main, f);
    paint(contexts.left, f.left, f);
    shownFrame = f;
    if (isFirst) {
        isFirst = false;
        firstFrameMs = performance.now() - scriptStart;
        document.body.dataset.firstFrameMs = firstFrameMs.toFixed(1);
        for (let i = engines.length; i < poolSize(); i++) engines.push(new Engine());
        showAbout();
        pump();
    }
    showNumbers(f);
    return true;
}

function showSplit() {
    const at = S.split;
    $("split").style.left = at + "%";
    $("split").setAttribute("aria-valuenow", at);
    $("split").setAttribute("aria-valuetext", at + " percent sharp");
    $("left").style.clipPath = "inset(0 " + (100 - at) + "% 0 0)";
    $("left").style.visibility = at > 0 ? "visible" : "hidden";
    $("sideLeft").style.opacity = at > 18 ? 1 : 0;
    $("sideRight").style.opacity = at < 82 ? 1 : 0;
}

const count = n => n.toLocaleString("en");
const kilo = bytes => bytes < 10240 ? count(bytes) + " B" : (bytes / 1024).toFixed(bytes < 102400 ? 1 : 0) + " kB";

let times = [];
function showNumbers(f) {
    const s = f.stats, ms = s.us / 1000, done = Math.round(100 * frames.size / period());
    if (!f.noted) { f.noted = true; times.push([s.us, s.sharp_us]); if (times.length > 20) times.shift(); }
    const mean = k => times.reduce((sum, t) => sum + t[k], 0) / times.length / 1000;
    $("frameText").textContent = "frame " + S.frame + " of " + period() + ", " + S.fps + " per second";
    $("speedText").textContent = frames.size < Math.min(period(), roomFor()) && !S.paused ? "drawing the loop, " + done + " %" : S.paused ? "paused" : "";
    $("meter").style.width = done + "%";
    $("crc").textContent = s.crc;
    $("crcFrame").textContent = S.frame;
    document.body.dataset.crc = s.crc;
    document.body.dataset.frame = S.frame;
    document.body.dataset.ms = ms.toFixed(2);
    if (S.paused || S.frame % 5 === 0 || !$("facts").firstChild) {
        const facts = [["Drawn here in", mean(0).toFixed(1) + " ms (" + Math.round(1000 / mean(0)) + " a second)"], ["Sharp frame", mean(1).toFixed(1) + " ms"],
            ["Memory of smear", kilo(s.arena) + (s.limit ? " of " + kilo(s.limit) : "")], ["Triangles", count(s.in) + ", " + count(s.drawn) + " drawn"],
            ["Tiles", tilesText(s)]];
        if (s.board_us > 0) {
            const pace = us => us < 1e6 ? (1e6 / us).toFixed(us > 1e5 ? 1 : 0) + " a second" : (us / 1e6).toFixed(1) + " s a frame";
            facts.push(["On the board: an estimate", pace(s.board_us + s.wire_us) + "; sharp " + pace(s.board_sharp_us + s.wire_us)]);
        }
        if (s.wire_us > 0) facts.push(["Bus to the panel", (s.wire_us / 1000).toFixed(1) + " ms a frame"]);
        if (s.dropped > 0) facts.push(["Left out", count(s.dropped) + " triangles: the memory is too small"]);
        fill($("facts"), facts);
    }
    showCommand();
}

function tilesText(s) {
    const parts = [["still", s.still], ["smooth", s.smooth], ["subframes", s.subframes], ["timemask", s.timemask], ["filtered", s.filtered],
        ["object", s.object], ["layered", s.layered]];
    return parts.filter(p => p[1] > 0).map(p => count(p[1]) + " " + p[0]).join(", ") || "whole frames";
}

function fill(list, facts) {
    list.replaceChildren(...facts.map(([name, value]) => {
        const div = document.createElement("div"), dt = document.createElement("dt"), dd = document.createElement("dd");
        dt.textContent = name;
        dd.textContent = value;
        div.append(dt, dd);
        return div;
    }));
}

function showCommand() {
    const quote = w => /^[\w.:\/=,+-]+$/.test(w) ? w : "'" + w.replace(/'/g, "'\\''") + "'";
    const list = words();
    list.splice(list.indexOf("--"), 1);
    const name = list.pop();
    const text = "build/smear render " + quote(name) + " " + list.map(quote).join(" ") + " --frames " + S.frame + "-" + S.frame + " --repeat 1";
    const note = turned ? "\n# the camera has been turned by hand: the command shows the scene's own"
        : isStill && S.spin ? "\n# the model is on a turntable here: the command shows it at rest"
        : shownFrame && shownFrame.stats.dropped > 0 ? "\n# triangles are left out for want of memory, fewer here and on the board than where pointers have 8 bytes" : "";
    if ($("command").textContent !== text + note) $("command").textContent = text + note;
}

function showAbout() {
    $("about").textContent = "One file, no network: the page has drawn its first frame " + Math.round(firstFrameMs) + " ms after its script began, with " + engines.length
        + (engines.length === 1 ? " worker, " : " workers, ") + (hasSimd ? "with" : "without") + " SIMD. smear is free software under the MIT licence.";
}

// ------------------------------------------------------------------ player

let due = 0;
function tick(now) {
    requestAnimationFrame(tick);
    if (S.paused || isFirst || changing) { due = now; return; }
    if (now < due) return;
    const next = (S.frame + 1) % period();
    if (period() > 1 && frames.has(next)) {
        S.frame = next;
        show();
        due = Math.max(due + 1000 / S.fps, now - 100);
    } else if (!frames.has(S.frame)) {
        due = now;
    }
    pump();
}

function pause(on) {
    S.paused = on;
    $("pause").setAttribute("aria-pressed", on);
    $("pause").setAttribute("aria-label", on ? "B: play" : "B: pause");
    writeAddress();
    show();
    pump();
}

function step(by) {
    pause(true);
    S.frame = (S.frame + by + period()) % period();
    writeAddress();
    if (!show()) pump();
}

// ------------------------------------------------------------------ controls

const knobs = [
    { key: "shutter", label: "Shutter", min: 0, max: 360, step: 5, stops: [0, 90, 180, 270, 360], text: v => v + "\u00b0",
      hint: v => v === 0 ? "Closed at once: the sharp frame." : "Open for " + Math.round(v / 3.6) + " % of each frame" + (v === 180 ? ", as film cameras have it." : ".") },
    { key: "method", label: "Method", min: 0, max: METHODS.length - 1, step: 1, stops: METHODS.map((m, i) => i), text: v => METHODS[v].label, hint: v => METHODS[v].hint },
    { key: "quality", label: "Quality", min: 0, max: 2, step: 1, stops: [0, 1, 2], text: v => QUALITIES[v],
      hint: v => {
          const m = METHODS[S.method];
          if (m.name === "auto") return "Error aimed at: " + ["4", "1.5", "0.5"][v] + " of 255 codes.";
          if (m.name === "none") return "A sharp frame has none.";
          return m.samples[v] ? m.samples[v] + " samples." : "This method has but one.";
      } },
    { key: "fps", label: "Frame rate", min: 0, max: 3, step: 1, stops: RATES, text: v => v + " per second", list: RATES,
      hint: v => v <= 15 ? "What small machines manage: the sharp side stutters."
          : v === 60 ? "More frames, shorter streaks." : "Each frame stands for " + Math.round(1000 / v) + " ms." },
];

function buildKnobs() {
    for (const k of knobs) {
        const div = document.createElement("div"), label = document.createElement("label"), out = document.createElement("output"), input = document.createElement("input");
        const hint = document.createElement("p"), stops = document.createElement("div");
        div.className = "knob";
        label.htmlFor = input.id = k.key;
        label.textContent = k.label;
        out.htmlFor = k.key;
        Object.assign(input, { type: "range", min: k.min, max: k.max, step: k.step });
        input.setAttribute("aria-describedby", hint.id = k.key + "Hint");
        hint.className = "hint";
        stops.className = k.stops.length > 5 ? "stops many" : "stops";
        const value = v => k.list ? k.list[v] : v;
        const choose = v => set(k.key === "fps" ? { fps: v, frame: Math.floor(S.frame * v / S.fps) } : { [k.key]: v });
        input.oninput = () => choose(value(+input.value));
        k.buttons = k.stops.map(v => {
            const b = document.createElement("button");
            b.type = "button";
            b.tabIndex = -1;
            b.textContent = k.key === "shutter" ? v + "\u00b0" : k.list ? v : k.text(v);
            b.setAttribute("aria-label", k.label + " " + k.text(v));
            b.style.left = 100 * (k.list ? k.list.indexOf(v) / (k.list.length - 1) : (v - k.min) / (k.max - k.min)) + "%";
            b.onclick = () => choose(v);
            stops.append(b);
            return b;
        });
        div.append(label, out, input, stops, hint);
        $("knobs").append(div);
        Object.assign(k, { input, out, hintLine: hint });
    }
}

function options(select, list, value) {
    select.replaceChildren(...list.map(([v, text]) => new Option(text, v, false, v === value)));
    select.value = value;
}

function showSettings() {
    for (const k of knobs) {
        const v = S[k.key];
        k.input.value = k.list ? k.list.indexOf(v) : v;
        k.input.setAttribute("aria-valuetext", k.text(v));
        k.out.textContent = k.text(v);
        k.hintLine.textContent = k.hint(v);
        k.buttons.forEach((b, i) => b.classList.toggle("on", k.stops[i] === v));
    }
    options($("panel"), PANELS.map(p => [p.name, p.label]), S.panel);
    options($("scene"), [...SCENES.map(s => [s.name, s.label]), ...(model ? [["file", model.main]] : [])], S.scene);
    $("device").dataset.shell = panel().shell;
    $("boardText").textContent = panel().what || "";
    $("blur").setAttribute("aria-pressed", METHODS[S.method].name !== "none");
    $("pause").setAttribute("aria-pressed", S.paused);
    times = [];
    showSplit();
    showChart();
    writeAddress();
}

function showScene() {
    $("clipRow").hidden = scene.clips.length < 2;
    isStill = S.scene === "file" && scene.clips.length === 0;
    $("spinRow").hidden = !isStill;
    $("spin").checked = S.spin === 1;
    options($("clip"), scene.clips.map((name, i) => [String(i), name || "clip " + i]), String(S.clip));
    fit();
    $("right").setAttribute("aria-label", "The scene as the panel shows it, " + scene.width + " by " + scene.height + " pixels, blurred");
}

let blurred = DEFAULTS.method;
function toggleBlur() {
    if (S.method !== 0) blurred = S.method;
    set({ method: S.method !== 0 ? 0 : blurred });
}

async function turn(yaw, pitch, factor) {
    if (!turned) poses.frame = S.frame;
    turned = true;
    poses.yaw += yaw;
    poses.pitch += pitch;
    poses.factor *= factor;
    pose();
}

let posing = false, poseAgain = false;
async function pose() {
    if (posing) { poseAgain = true; return; }
    posing = true;
    do {
        poseAgain = false;
        const wanted = ++epoch;
        forget();
        // Told at once: what an engine draws from here on it draws after this.
        await Promise.all(engines.filter(e => e.openKey === openKey()).map(e => {
            e.epoch = wanted;
            return e.ask("turn", { ...poses, spin: e.spin, straight: true }, 30000);
        }));
    } while (poseAgain);
    posing = false;
    pump();
}

function straighten() {
    poses.yaw = poses.pitch = 0;
    poses.factor = 1;
    pose().then(() => { turned = false; showCommand(); });
}

function bindScreen() {
    let drag = null;
    const box = $("screen");
    const divide = e => { const r = box.getBoundingClientRect(); S.split = Math.round(Math.min(100, Math.max(0, 100 * (e.clientX - r.left) / r.width))); showSplit(); };
    $("split").onpointerdown = e => { e.stopPropagation(); drag = "split"; $("split").setPointerCapture(e.pointerId); divide(e); };
    $("split").onpointermove = e => { if (drag === "split") divide(e); };
    $("split").onpointerup = $("split").onpointercancel = () => { drag = null; writeAddress(); };
    $("split").onkeydown = e => {
        const by = { ArrowLeft: -5, ArrowDown: -5, ArrowRight: 5, ArrowUp: 5, Home: -100, End: 100, PageDown: -20, PageUp: 20 }[e.key];
        if (by === undefined) return;
        e.preventDefault();
        moveSplit(by);
    };
    box.onpointerdown = e => { drag = { x: e.clientX, y: e.clientY, id: e.pointerId }; };
    box.onpointermove = e => {
        if (!drag || drag === "split" || e.buttons === 0) return;
        const side = Math.min(box.clientWidth, box.clientHeight), dx = (e.clientX - drag.x) / side, dy = (e.clientY - drag.y) / side;
        if (Math.abs(dx) + Math.abs(dy) < 0.01) return;
        if (!box.hasPointerCapture(e.pointerId)) box.setPointerCapture(e.pointerId);
        Object.assign(drag, { x: e.clientX, y: e.clientY });
        turn(-dx * 2.5, -dy * 2.5, 1);
    };
    box.onpointerup = box.onpointercancel = () => { drag = null; };
    box.addEventListener("wheel", e => { if (e.ctrlKey || e.shiftKey) { e.preventDefault(); turn(0, 0, e.deltaY > 0 ? 1.1 : 1 / 1.1); } }, { passive: false });
}

function moveSplit(by) {
    S.split = Math.min(100, Math.max(0, S.split + by));
    showSplit();
    writeAddress();
}

// A board begins with the method that its memory has room for, as `smear view --board` does.
function choosePanel(name) {
    const to = PANELS.find(p => p.name === name), own = to.method >= 0 ? to.method : panel().method >= 0 ? DEFAULTS.method : S.method;
    set({ panel: name, method: own });
}

function nextPanel(by) {
    choosePanel(PANELS[(PANELS.indexOf(panel()) + by + PANELS.length) % PANELS.length].name);
}

const KEYS = {
    " ": () => pause(!S.paused), ",": () => step(-1), ".": () => step(1), b: toggleBlur, m: () => set({ method: (S.method + 1) % METHODS.length }),
    M: () => set({ method: (S.method + METHODS.length - 1) % METHODS.length }), u: () => set({ quality: (S.quality + 1) % 3 }),
    "[": () => set({ shutter: Math.max(0, S.shutter - 15) }), "]": () => set({ shutter: Math.min(360, S.shutter + 15) }),
    v: () => { S.split = S.split > 0 ? 0 : 50; showSplit(); writeAddress(); }, "<": () => moveSplit(-5), ">": () => moveSplit(5),
    f: () => nextPanel(1), F: () => nextPanel(-1), x: straighten, g: () => record(), l: () => set({ light: S.light === "linear" ? "encoded" : "linear" }),
};

function bindControls() {
    buildKnobs();
    bindScreen();
    $("scene").onchange = e => set({ scene: e.target.value, clip: 0, frame: 0 });
    $("panel").onchange = e => choosePanel(e.target.value);
    $("clip").onchange = e => set({ clip: +e.target.value, frame: 0 });
    $("spin").onchange = e => set({ spin: e.target.checked ? 1 : 0, frame: 0 });
    $("pause").onclick = () => pause(!S.paused);
    $("blur").onclick = toggleBlur;
    $("stepBack").onclick = () => step(-1);
    $("stepOn").onclick = () => step(1);
    $("reset").onclick = () => { S = { ...DEFAULTS }; straighten(); set({}); };
    $("gif").onclick = () => record();
    $("copy").onclick = () => {
        const done = () => { $("copy").textContent = "Copied"; setTimeout(() => { $("copy").textContent = "Copy the command"; }, 1500); };
        const range = document.createRange();
        range.selectNodeContents($("command"));
        getSelection().removeAllRanges();
        getSelection().addRange(range);
        if (navigator.clipboard) navigator.clipboard.writeText($("command").textContent).then(done, () => {});
        else if (document.execCommand("copy")) done();
    };
    for (const b of document.querySelectorAll("[data-turn]"))
        b.onclick = () => {
            if (b.dataset.turn === "reset") { straighten(); return; }
            const [yaw, pitch] = b.dataset.turn.split(",");
            turn(+yaw * Math.PI / 18, +pitch * Math.PI / 18, 1);
        };
    document.addEventListener("keydown", e => {
        if (e.ctrlKey || e.altKey || e.metaKey || !KEYS[e.key]) return;
        const on = e.target.tagName;
        const isBox = e.target.type === "checkbox", presses = isBox || /^(BUTTON|A|SUMMARY|LABEL)$/.test(on);
        if (on === "SELECT" || (on === "INPUT" && e.target.type !== "range" && !isBox) || (e.key === " " && presses)) return;
        e.preventDefault();
        KEYS[e.key]();
    });
    window.addEventListener("hashchange", () => { readAddress(); change(); });
    window.addEventListener("resize", fit);
}

// ------------------------------------------------------------------ chart

const CURVES = [["accumulate", "accumulate: N whole frames", "#a9b2c3"], ["reconstruct", "reconstruct: N taps", "#f0b429"],
    ["camera", "camera: from depth", "#d8875a"], ["pingpong", "ping-pong: 8 and 8 taps", "#a6d854"], ["half", "half: at half the size", "#e59ad6"],
    ["object", "object: one velocity each", "#66d9ef"], ["layered", "layered: N taps", "#b79cf0"], ["subframes", "subframes: up to N", "#35c48d"],
    ["timemask", "timemask: N slots", "#5aa9f5"], ["auto", "auto", "#ff7ab8"]];

const ANY = 3;                          // quality, of methods that have but one

// [{ setting, method, index, quality, label, cost, rmse }] of chart.csv; what the page does not offer is left out.
function readChart(text) {
    const rows = text.trim().split("\n").slice(1).map(line => {
        const [setting, cost, rmse] = line.split(","), [method, at, more] = setting.split(" "), index = methodNamed(method);
        if (index < 0 || more || !(cost > 0) || !(rmse > 0)) return null;
        const samples = METHODS[index].samples, quality = method === "auto" ? QUALITIES.indexOf(at) : at ? samples.indexOf(+at) : samples[0] ? -1 : ANY;
        return method !== "auto" && at && !(+at > 0) ? null : { setting, method, index, quality, label: at || METHODS[index].label, cost: +cost, rmse: +rmse };
    });
    return rows.filter(r => r);
}

const chartRows = readChart(pageTexts[2]), sharpRow = chartRows.find(r => r.method === "none");

function current() {
    const method = S.shutter === 0 ? 0 : S.method;
    return chartRows.find(r => r.index === method && (r.quality === S.quality || r.quality === ANY));
}

function svg(name, attributes, text) {
    const e = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const key in attributes) e.setAttribute(key, attributes[key]);
    if (text !== undefined) e.textContent = text;
    return e;
}

const LEFT = 52, RIGHT = 606, TOP = 14, BOTTOM = 352, COST = [0.85, 45], ERROR = [0.3, 16];
const toX = cost => LEFT + (RIGHT - LEFT) * Math.log(cost / COST[0]) / Math.log(COST[1] / COST[0]);
const toY = error => BOTTOM - (BOTTOM - TOP) * Math.log(error / ERROR[0]) / Math.log(ERROR[1] / ERROR[0]);

function buildChart() {
    const c = $("chart");
    for (const v of [1, 2, 5, 10, 20, 40]) {
        c.append(svg("line", { class: "axis", x1: toX(v), x2: toX(v), y1: TOP, y2: BOTTOM }), svg("text", { x: toX(v), y: BOTTOM + 17, "text-anchor": "middle" }, v + "\u00d7"));
    }
    for (const v of [0.5, 1, 2, 5, 10])
        c.append(svg("line", { class: "axis", x1: LEFT, x2: RIGHT, y1: toY(v), y2: toY(v) }), svg("text", { x: LEFT - 7, y: toY(v) + 4, "text-anchor": "end" }, v));
    c.append(svg("text", { x: (LEFT + RIGHT) / 2, y: BOTTOM + 38, "text-anchor": "middle" }, "cost of a frame, relative to the sharp one"));
    const middle = (TOP + BOTTOM) / 2;
    c.append(svg("text", { x: 14, y: middle, "text-anchor": "middle", transform: "rotate(-90 14 " + middle + ")" }, "error against the truth, in codes of 255"));
    let legend = 0;
    CURVES.forEach(([method, label, color]) => {
        const rows = chartRows.filter(r => r.method === method).sort((a, b) => a.cost - b.cost);
        if (rows.length === 0) return;
        c.append(svg("polyline", { points: rows.map(r => toX(r.cost) + "," + toY(r.rmse)).join(" "), fill: "none", stroke: color, "stroke-width": method === "auto" ? 3 : 1.6 }));
        c.append(svg("circle", { cx: RIGHT - 178, cy: TOP + 12 + legend, r: 5, fill: color }), svg("text", { x: RIGHT - 166, y: TOP + 16 + legend }, label));
        legend += 17;
        rows.forEach(r => addPoint(c, r, color));
    });
    if (sharpRow) addPoint(c, sharpRow, "#ffffff");
    c.append(svg("circle", { id: "ring", r: 13, fill: "none", stroke: "#ffffff", "stroke-width": 2.5, "pointer-events": "none" }));
    const rows = [["setting", "cost", "error"], ...chartRows.map(r => [r.setting, r.cost.toFixed(2) + "\u00d7", r.rmse.toFixed(2)])];
    const table = document.createElement("table");
    rows.forEach((row, i) => { const tr = table.insertRow(); row.forEach(v => { const td = document.createElement(i ? "td" : "th"); td.textContent = v; tr.append(td); }); });
    $("chartTable").append(table);
}

function addPoint(c, r, color) {
    const usable = r.quality >= 0, x = toX(r.cost), y = toY(r.rmse);
    const point = svg("circle", { cx: x, cy: y, r: usable ? 6 : 3.5, fill: color, class: usable ? "point" : "" });
    const title = r.setting + ": " + r.cost.toFixed(1) + " times the sharp frame, error " + r.rmse.toFixed(2) + " codes";
    point.append(svg("title", {}, title));
    if (usable) {
        const pick = () => set({ method: r.index, quality: r.quality === ANY ? S.quality : r.quality, shutter: S.shutter || 180 });
        point.setAttribute("tabindex", 0);
        point.setAttribute("role", "button");
        point.setAttribute("aria-label", title);
        point.onclick = pick;
        point.onkeydown = e => { if (e.key === "Enter" || e.key === " ") { e.preventDefault(); e.stopPropagation(); pick(); } };
    }
    c.append(point);
    const isLeft = r.label === "balanced", below = r.label === "fine" || r.label === "balanced";         // the two lie close to each other
    if (usable && (r.method === "accumulate" || r.method === "auto" || r.method === "none"))
        c.append(svg("text", { x: isLeft ? x - 14 : x + (below ? 14 : 10), y: below ? y + 20 : y - 8, "text-anchor": isLeft ? "end" : "start" }, r.label));
}

function showChart() {
    const r = current();
    $("ring").setAttribute("visibility", r ? "visible" : "hidden");
    if (!r || !sharpRow) { $("chartText").textContent = "Now: a setting that has not been measured."; return; }
    $("ring").setAttribute("cx", toX(r.cost));
    $("ring").setAttribute("cy", toY(r.rmse));
    const times = sharpRow.rmse / r.rmse, by = times.toFixed(times < 3 ? 1 : 0);
    $("chartText").textContent = r === sharpRow ? "Now: the sharp frame, " + sharpRow.rmse.toFixed(1) + " codes from what a camera would see."
        : "Now: " + r.setting + ", " + r.cost.toFixed(1) + " times the instructions of the sharp frame, " + by + " times nearer to the truth.";
}

// ------------------------------------------------------------------ models

const LARGEST = 512 << 20;
let serial = 0, busyWithModel = false;

function mainOf(files) {
    return files.find(f => /\.(glb|gltf|obj)$/i.test(f.name)) || files.find(f => !/\.(mtl|bin|png|jpe?g)$/i.test(f.name)) || files[0];
}

async function takeFiles(list) {
    const files = [...list];
    if (files.length === 0 || busyWithModel) return;
    const say = text => complain($("dropText"), text);
    const total = files.reduce((sum, f) => sum + f.size, 0), main = mainOf(files);
    if (files.length > 32) return say("At most 32 files at once, please: a model and its textures.");
    if (total > LARGEST) return say(main.name + ": is too large for this page (" + count(Math.round(total / 1048576)) + " MB, at most " + (LARGEST >> 20) + ").");
    busyWithModel = true;
    say("Reading " + main.name + " ...");
    try {
        const read = [];
        for (const f of files) read.push({ name: shortName(f.name), bytes: await f.arrayBuffer() });
        const next = { main: shortName(main.name), files: read, serial: ++serial };
        await openModel(next, say, total);
    } catch (error) {
        say(main.name + ": cannot be read (" + (error && error.message || error) + ")");
    }
    busyWithModel = false;
}

const shortName = name => name.replace(/[\u0000-\u001f/\\]/g, "_").slice(-100);

// Tried on an engine of its own, so that a file that breaks it breaks nothing that is shown.
async function openModel(next, say, total) {
    const trial = new Engine();
    await trial.started;
    const options = words();
    const opened = await trial.ask("open", { words: [...options.slice(0, options.indexOf("--")), "--loop", "--", next.main], board: panel().board, files: next.files }, 30000);
    let drawn = opened;
    if (opened.status === 0) drawn = await trial.ask("draw", { frame: 0 }, 30000);
    if (drawn.status !== 0) {
        const missing = /No such file/.test(drawn.err) ? ". Drop it together with the model." : "";
        say((clean(drawn.err) || next.main + ": cannot be shown") + missing);
        trial.worker.terminate();
        return;
    }
    say(clean(opened.err));
    model = next;
    set({ scene: "file", clip: 0, frame: 0 });
    await convert(trial, say);
    trial.worker.terminate();
    if (total < 1 << 20) $("model").scrollIntoView({ block: "nearest" });
}

async function convert(engine, say) {
    const base = model.main.replace(/\.[^.]*$/, "") || "model";
    const make = async (ending, link) => {
        const output = base + ending;
        const answer = await engine.ask("convert", { words: ["-o", output, "--", model.main], output, files: model.files }, 60000);
        if (link.href.startsWith("blob:")) URL.revokeObjectURL(link.href);
        if (answer.status !== 0) { link.removeAttribute("href"); return answer; }
        link.href = URL.createObjectURL(new Blob([answer.bytes], { type: ending === ".h" ? "text/x-c" : "application/octet-stream" }));
        link.download = output;
        return answer;
    };
    const header = await make(".h", $("header"));
    $("modelName").textContent = model.main;
    $("model").hidden = header.status !== 0;
    $("noModel").hidden = header.status === 0;
    if (header.status !== 0) { say(clean(header.err)); return; }
    await make(".smr", $("blob"));
    $("report").textContent = header.out;
    const find = (pattern, otherwise) => (header.out.match(pattern) || [0, otherwise])[1];
    fill($("modelFacts"), [["Flash", kilo(+find(/^flash: (\d+)/m, 0))], ["RAM, an actor with two poses", kilo(+find(/^ram: (\d+)/m, 0))],
        ["Triangles", find(/^triangles: (\d+)/m, "?")], ["Vertices", find(/^vertices: (\d+)/m, "?")], ["Clips", find(/^clips: (\d+)/m, "0")],
        ["Largest error", find(/position error: ([\d.]+) px, at/m, "?") + " px"]]);
}

function bindDrop() {
    let depth = 0;
    const over = on => document.body.classList.toggle("over", on);
    document.addEventListener("dragenter", e => { e.preventDefault(); depth++; over(true); });
    document.addEventListener("dragleave", () => { if (--depth <= 0) { depth = 0; over(false); } });
    document.addEventListener("dragover", e => e.preventDefault());
    document.addEventListener("drop", e => {
        e.preventDefault();
        depth = 0;
        over(false);
        const files = e.dataTransfer ? [...e.dataTransfer.files] : [];
        if (files.length === 0) { complain($("dropText"), "That was no file. Drop a .glb, .gltf or .obj."); return; }
        takeFiles(files);
    });
    $("file").onchange = e => { takeFiles(e.target.files); e.target.value = ""; };
}

// ------------------------------------------------------------------ film

let filming = false;
async function record() {
    if (filming || !shownFrame) return;
    filming = true;
    $("gif").disabled = true;
    const say = text => complain($("gifText"), text);
    const engine = new Engine();
    await engine.started;
    let answer = await tune(engine);
    if (answer.status === 0) {
        const length = scene.period > 1 ? Math.min(period(), 240) : 1;
        say("Recording ...");
        answer = await engine.ask("gif", { first: 0, count: length, delay: Math.round(1000 / S.fps) }, 300000, p => say("Recording, " + Math.round(100 * p) + " %"));
    }
    engine.worker.terminate();
    if (answer.status === 0) {
        const link = document.createElement("a");
        link.href = URL.createObjectURL(new Blob([answer.bytes], { type: "image/gif" }));
        link.download = "smear.gif";
        link.textContent = "smear.gif";
        $("gifText").replaceChildren("Recorded: ", link, ", " + kilo(answer.bytes.byteLength) + (period() <= 240 ? ", a perfect loop." : ", its first 240 frames."));
        document.body.dataset.gif = link.href;
        link.click();
    } else {
        say("");
        complain($("trouble"), clean(answer.err));
    }
    $("gif").disabled = false;
    filming = false;
}

// ------------------------------------------------------------------ the beginning

function poolSize() {
    const cores = navigator.hardwareConcurrency || 2;
    return cores >= 8 ? 4 : cores >= 4 ? 3 : cores >= 2 ? 2 : 1;
}

async function begin() {
    hasSimd = WebAssembly.validate(new Uint8Array(SIMD_PROBE)) && !/[?&]simd=0/.test(location.search);
    workerUrl = URL.createObjectURL(new Blob([$("unpack").textContent, pageTexts[1]], { type: "text/javascript" }));
    engines = [new Engine()];
    const started = await engines[0].started;
    if (started.status !== 0) { fatal("The module does not start: " + started.err); return; }
    const answer = await engines[0].ask("boards", {}, 10000);
    answer.boards.forEach((b, i) => {
        const drawn = ["--size", "--format", "--dither", "--arena"], list = [];
        b.options.forEach((o, k) => { if (drawn.includes(o)) list.push(o, b.options[k + 1]); });
        const own = methodNamed(b.options[b.options.indexOf("--method") + 1]);
        PANELS.push({ name: b.name, label: LABELS[b.name] || b.name, what: b.what, shell: SHELLS[b.name] || "board", words: list, board: i, method: own });
    });
    readAddress();
    mayLighten = !location.hash;
    if (!location.hash && matchMedia("(prefers-reduced-motion: reduce)").matches) S.paused = true;
    change();
    requestAnimationFrame(tick);
}

bindControls();
buildChart();
bindDrop();
begin();
