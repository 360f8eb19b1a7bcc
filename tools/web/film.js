// SPDX-License-Identifier: MIT
// film.js - records the loop as a GIF.

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
