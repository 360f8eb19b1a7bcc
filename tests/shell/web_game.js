// SPDX-License-Identifier: MIT
// web_game.js - the game's page as a player has it: headless Chromium, driven through WebDriver.
//
//     node tests/shell/web_game.js build/web/game.html
//
// Every test begins with its name and fails alone. A screenshot is left beside the page.
"use strict";
const fs = require("fs"), path = require("path"), { Browser, runTests, check, equal } = require("./web_driver.js");

const page = path.resolve(process.argv[2]), folder = path.dirname(page), root = path.resolve(__dirname, "../..");
let browser;

async function open(file = page) {
    await browser.go("about:blank");
    await browser.go("file://" + file);
    check(await browser.until("document.body.dataset.state"), "the page does not begin");
}

async function starts() {
    await open();
    equal(await browser.run("return document.body.dataset.state"), "runs", "state");
    check(await browser.until("shown > 5"), "nothing is drawn");
}

// What a copy of the page says that this was done to.
async function saysOf(change) {
    const copy = path.join(folder, "game-broken.html");
    fs.writeFileSync(copy, change(fs.readFileSync(page, "utf8")));
    try {
        await open(copy);
        equal(await browser.run("return document.body.dataset.state"), "failed", "state");
        return await browser.text("#fatal[role]");
    } finally {
        fs.rmSync(copy);
    }
}

const tests = {
    "one file of at most 80 kB that asks for nothing": async () => {
        const size = fs.statSync(page).size, text = fs.readFileSync(page, "utf8");
        check(size <= 80 * 1024, "the page has " + size + " bytes");
        check(!/(src|href)=["']?(https?:)?\/\//.test(text), "the page names a server");
        await starts();
        const got = await browser.run("return performance.getEntriesByType('resource').map(e => e.name).filter(n => !n.startsWith('data:'))");
        equal(got.length, 0, "asked for " + got.join(" "));
        console.log("the game's page has " + size + " bytes");
    },
    "the recorded race has the host's frames and times": async () => {
        const laps = fs.readFileSync(path.join(root, "platform/game/lap.txt"), "utf8").split("\n");
        await starts();
        const want = laps.filter(l => l.startsWith("page ")).map(l => l.slice(5) + "\n").join("");
        check(want.includes("best lap"), "platform/game/lap.txt has no race of the page");
        equal(await browser.run("cancelAnimationFrame(ticket); return replay(arguments[0])", "game check page 200"), want, "page");
    },
    "it moves in the race's time, in squares of whole pixels, and says how fast": async () => {
        await starts();
        const rate = await browser.until("/frames per second/.test(at('rate').textContent) && at('rate').textContent", 20);
        check(rate !== null, "no frame rate");
        console.log(rate);
        const from = await browser.run("return [time, shown]");
        await new Promise(done => setTimeout(done, 1500));
        const to = await browser.run("return [time, shown]"), due = (to[0] - from[0]) * 0.03;
        check(to[1] - from[1] <= due + 2 && to[1] > from[1], to[1] - from[1] + " frames in the time of " + due);
        const zoom = await browser.run("return [parseFloat(canvas.style.width) / canvas.width, parseFloat(canvas.style.height) / canvas.height, getComputedStyle(canvas).imageRendering]");
        check(zoom[0] >= 2 && zoom[0] === Math.floor(zoom[0]) && zoom[0] === zoom[1], "each pixel is " + zoom);
        equal(zoom[2], "pixelated", "image-rendering");
        const colors = await browser.run("const d = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data, s = new Set(); for (let i = 0; i < d.length; i += 4) s.add(d[i] << 16 | d[i + 1] << 8 | d[i + 2]); return s.size");
        check(colors > 100, "only " + colors + " colours");
        await browser.until("time > 3500", 20);
        await browser.picture(path.join(folder, "game.png"));
    },
    "keys, buttons and fingers steer, and are let go": async () => {
        await starts();
        const press = (type, key) => browser.run("document.body.dispatchEvent(new KeyboardEvent(arguments[0], { key: arguments[1], bubbles: true })); return held()", type, key);
        for (const [key, bit] of [["ArrowLeft", 4], ["D", 8], ["ArrowDown", 2], ["Enter", 32], ["x", 16]]) {
            equal(await press("keydown", key), bit, key);
            equal(await press("keyup", key), 0, key + " let go");
        }
        const touch = (type, css, x) => browser.run(`const e = document.querySelector(arguments[1]), b = e.getBoundingClientRect();
            e.dispatchEvent(new PointerEvent(arguments[0], { pointerId: 7, bubbles: true, cancelable: true, clientX: b.left + b.width * arguments[2], clientY: b.top + 9 }));
            return held();`, type, css, x);
        for (const [css, x, bit] of [["[data-key='2']", 0.5, 2], ["[data-key='8']", 0.5, 8], ["canvas", 0.2, 4], ["canvas", 0.8, 8]]) {
            equal(await touch("pointerdown", css, x), bit, css);
            check(await browser.run("return !!document.querySelector('.held')"), "no button looks held");
            equal(await touch("pointerup", css, x), 0, css + " let go");
        }
        await press("keydown", "ArrowLeft");
        equal(await browser.run("dispatchEvent(new Event('blur')); return held()"), 0, "keys of a window that is left");
    },
    "half of it is shown sharp, and it is heard": async () => {
        await starts();
        const press = type => browser.run("document.body.dispatchEvent(new KeyboardEvent(arguments[0], { key: 'x', bubbles: true }))", type);
        const before = await browser.run("return shown");
        await press("keydown");
        check(await browser.until("shown > " + (before + 2)), "no frames after the key");
        await press("keyup");
        await browser.picture(path.join(folder, "game-split.png"));
        await browser.run("at('sound').click()");
        check(await browser.until("heard > 0 || audio.state !== 'running'"), "no samples were played");
        console.log("sound: " + await browser.run("return audio.state + ', ' + heard"));
    },
    "it waits while it is hidden": async () => {
        await starts();
        const hide = is => browser.run("Object.defineProperty(document, 'hidden', { value: arguments[0], configurable: true }); document.dispatchEvent(new Event('visibilitychange'));", is);
        await hide(true);
        equal(await browser.text("#rate"), "paused", "text");
        const then = await browser.run("return [time, shown]");
        await new Promise(done => setTimeout(done, 1500));
        equal((await browser.run("return [time, shown]")).join(), then.join(), "time and frames while hidden");
        await hide(false);
        check(await browser.until("shown > " + then[1]), "it does not go on");
        check(await browser.run("return time") < then[0] + 1400, "the time that it was hidden counts");
    },
    "a telephone's screen has all of it": async () => {
        await browser.resize(400, 800);
        try {
            await starts();
            const boxes = await browser.run("return [innerWidth, innerHeight, ...['picture', 'pads', 'keys'].flatMap(id => { const b = at(id).getBoundingClientRect(); return [b.left, b.right, b.bottom]; })]");
            for (let i = 2; i < boxes.length; i += 3)
                check(boxes[i] >= 0 && boxes[i + 1] <= boxes[0] && boxes[i + 2] <= boxes[1], "something lies outside: " + boxes);
            await browser.picture(path.join(folder, "game-phone.png"));
        } finally {
            await browser.resize(1280, 900);
        }
    },
    "a page without its program says so, and a damaged one": async () => {
        const without = text => text.replace(/(id="game">)[^<]*/, "$1"), cut = text => text.replace(/(id="game">)([^<]*)/, (all, tag, bytes) => tag + bytes.slice(0, 20000));
        const other = text => text.replace(/(id="game">)([^<]*)/, (all, tag, bytes) => tag + bytes.slice(0, 30000) + "zzzz" + bytes.slice(30004));
        const noWasm = text => text.replace('"use strict";', '"use strict"; delete globalThis.WebAssembly;');
        check(/^The race does not start: the program is missing/.test(await saysOf(without)), "without: " + await saysOf(without));
        check(/damaged/.test(await saysOf(cut)), "cut: " + await saysOf(cut));
        check(/damaged/.test(await saysOf(other)), "changed: " + await saysOf(other));
        check(/has no WebAssembly/.test(await saysOf(noWasm)), "none: " + await saysOf(noWasm));
    },
};

runTests(tests, async () => browser = await Browser.open(path.join(folder, "browser-game")));
