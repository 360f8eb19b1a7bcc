// SPDX-License-Identifier: MIT
// app.js - the page begins. begin.js has joined these scripts, in this order:
//
//     methods.js    what there is to choose from (written by methods.c)
//     settings.js   what the user has chosen
//     engines.js    workers with the module
//     frames.js     drawn ahead of the one that is shown
//     screen.js     shows them
//     controls.js, chart.js, models.js, film.js

async function begin() {
    hasSimd = WebAssembly.validate(new Uint8Array(SIMD_PROBE)) && !/[?&]simd=0/.test(location.search);
    workerUrl = URL.createObjectURL(new Blob([$("unpack").textContent, workerText], { type: "text/javascript" }));
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
