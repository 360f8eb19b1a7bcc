// SPDX-License-Identifier: MIT
// engines.js - workers with the module, each brought to the present settings before it draws.

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
    ask(command, message, limit, progress) {
        return new Promise(resolve => {
            const id = ++this.serial, entry = { resolve, progress };
            this.waiting.set(id, entry);
            this.busy++;
            if (limit)
                entry.timer = setTimeout(() => this.die("this takes too long (more than " + limit / 1000 + " s)"), limit);
            this.worker.postMessage({ ...message, command, id });
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

function poolSize() {
    const cores = navigator.hardwareConcurrency || 2;
    return cores >= 8 ? 4 : cores >= 4 ? 3 : cores >= 2 ? 2 : 1;
}
