// SPDX-License-Identifier: MIT
// frames.js - frames are drawn ahead of the one that is shown, and kept until a setting changes.

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
