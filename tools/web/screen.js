// SPDX-License-Identifier: MIT
// screen.js - shows frames and what is known of them, one after the other at their pace.

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
            facts.push(["On the board: an estimate", pace(s.board_us + s.wire_us) + "; sharp " + pace(s.board_sharp_us + s.wire_us)]);
        }
        if (s.wire_us > 0) facts.push(["Bus to the panel", (s.wire_us / 1000).toFixed(1) + " ms a frame"]);
        if (s.dropped > 0) facts.push(["Left out", count(s.dropped) + " triangles: the memory is too small"]);
        fill($("facts"), facts);
    }
    showCommand();
}

function tilesText(s) {
    const parts = [["still", s.still], ["subframes", s.subframes], ["timemask", s.timemask], ["filtered", s.filtered],
        ["object", s.object], ["layered", s.layered]];
    return parts.filter(p => p[1] > 0).map(p => count(p[1]) + " " + p[0]).join(", ") || "whole frames";
}

const pace = us => us < 1e6 ? (1e6 / us).toFixed(us > 1e5 ? 1 : 0) + " a second" : (us / 1e6).toFixed(1) + " s a frame";

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
