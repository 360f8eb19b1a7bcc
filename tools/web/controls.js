// SPDX-License-Identifier: MIT
// controls.js - knobs, keys and the pointer.

const knobs = [
    { key: "shutter", label: "Shutter", min: 0, max: 360, step: 5, stops: [0, 90, 180, 270, 360], text: v => v + "\u00b0",
      hint: v => v === 0 ? "Closed at once: the sharp frame." : "Open for " + Math.round(v / 3.6) + " % of each frame" + (v === 180 ? ", as film cameras have it." : ".") },
    { key: "method", label: "Method", min: 0, max: METHODS.length - 1, step: 1, stops: METHODS.map((m, i) => i), text: v => METHODS[v].label, hint: v => METHODS[v].hint },
    { key: "quality", label: "Quality", min: 0, max: 3, step: 1, stops: [0, 1, 2, 3], text: v => QUALITIES[v],
      hint: v => {
          const m = METHODS[S.method];
          if (m.name === "auto") return v === 0 ? "What stands still is blurred along lines while the camera moves." : "Error aimed at: " + ["4", "1.5", "0.5"][v - 1] + " of 255 codes.";
          if (m.name === "none") return "A sharp frame has none.";
          return samplesOf(m, v) ? samplesOf(m, v) + " samples." : "This method has but one.";
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
    offerSketch();
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
    M: () => set({ method: (S.method + METHODS.length - 1) % METHODS.length }), u: () => set({ quality: (S.quality + 1) % QUALITIES.length }),
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
