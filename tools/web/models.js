// SPDX-License-Identifier: MIT
// models.js - what is dropped on the page: shown, and converted for download, as a program, too.

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

// Libraries of displays, as `smear convert --display` has them.
const DISPLAYS = [["lovyangfx", "Arduino: LovyanGFX"], ["arduino_gfx", "Arduino: GFX Library for Arduino"], ["tft_espi", "Arduino: TFT_eSPI"],
    ["adafruit_gfx", "Arduino: Adafruit GFX"], ["u8g2", "Arduino: U8g2"], ["ili9341_t4", "Arduino on Teensy 4: ILI9341_T4"], ["esp_lcd", "ESP-IDF: esp_lcd"]];
let kit = null, display = null, sketched = "", sketching = false;

// A program for the panel that is shown, and what it takes there; again when the settings change. What the library is made of is unpacked when
// it is first needed.
async function offerSketch() {
    const option = name => { const i = panel().words.indexOf(name); return i < 0 ? null : panel().words[i + 1]; };
    const chosen = display || (option("--format") === "l1pages" ? "u8g2" : "lovyangfx"), quality = METHODS[S.method].name === "none" ? "sharp" : QUALITIES[sampleQuality(S.quality)];
    const key = [model && model.serial, S.panel, chosen, quality].join("|");
    options($("sketchFor"), DISPLAYS, chosen);
    if (!model || sketching || key === sketched) return;
    sketching = true;
    sketched = key;
    if (!kit) [kit] = await filesOf(packed("unlzma"), packed("kit"));
    const engine = new Engine(), link = $("sketch"), files = [...model.files, { name: "kit.tar", bytes: kit.buffer }];
    await engine.started;
    const output = (model.main.replace(/\.[^.]*$/, "") || "model") + ".zip", arena = option("--arena");
    const answer = await engine.ask("convert", { output, files, words: ["-o", output, "--kit", "kit.tar", "--display", chosen, "--size", option("--size"), "--quality", quality,
        ...(arena ? ["--max-ram", arena] : []), "--", model.main] }, 60000);
    const number = pattern => +(answer.out.match(pattern) || [0, 0])[1], facts = [];
    if (link.href.startsWith("blob:")) URL.revokeObjectURL(link.href);
    link.hidden = answer.status !== 0;
    complain($("sketchText"), answer.status === 0 ? "" : clean(answer.err));
    if (answer.status === 0) {
        link.href = URL.createObjectURL(new Blob([answer.bytes], { type: "application/zip" }));
        link.download = output;
        const rate = await rateOn(engine, quality), at = number(/, (\d+) triangles at once/);
        facts.push(["RAM" + (arena ? " of " + kilo(+arena) : ""), kilo(number(/^ram of the sketch: (\d+)/m))], ["Flash, with the library by -O2", kilo(number(/^flash of the sketch: (\d+)/m))],
            [panel().board < 0 ? "A board's rate" : "On the board, by -O2: an estimate", rate], ["Triangles at once", at < number(/^triangles: (\d+)/m) ? at + ", more in parts" : String(at)]);
    }
    fill($("sketchFacts"), facts);
    engine.worker.terminate();
    sketching = false;
    document.body.dataset.sketch = key;
    offerSketch();
}

// Of a few frames of the model as the page sees it.
async function rateOn(engine, quality) {
    const words = [...panel().words, "--fps", String(S.fps), "--light", "encoded", "--loop", "--method", quality === "sharp" ? "none" : "auto",
        ...(quality === "sharp" ? [] : ["--quality", quality]), "--", model.main];
    const opened = await engine.ask("open", { words, board: panel().board, files: model.files }, 30000), frames = [];
    if (opened.status !== 0 || panel().board < 0) return "choose a board's panel above";
    if (opened.scene.period === 0) await engine.ask("turn", { ...poses, frame: 0, spin: Math.PI, straight: true }, 30000);
    for (let i = 1; i <= 4; i++) {
        const drawn = await engine.ask("draw", { frame: Math.round(i * (opened.scene.period || 2 * S.fps) / 5) }, 30000);
        if (drawn.status === 0 && drawn.stats.board_us > 0) frames.push(drawn.stats);
    }
    const mean = key => frames.reduce((sum, f) => sum + f[key], 0) / frames.length;
    return frames.length === 0 ? "not known" : pace(mean("board_us") + mean("wire_us")) + " (" + (mean("instructions") / 1e6).toFixed(1) + " M instructions)";
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
    $("sketchFor").onchange = () => { display = $("sketchFor").value; offerSketch(); };
    $("file").onchange = e => { takeFiles(e.target.files); e.target.value = ""; };
}
