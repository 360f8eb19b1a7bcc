// SPDX-License-Identifier: MIT
// web_bench.js - frames per second of the page's demo at 240x240: `make web-bench`. One worker draws the loop twice; the
// second time counts, frame by frame the faster of two more: what the machine can do while others use it, too.
"use strict";
const path = require("path"), { Browser } = require("./web_driver.js");

const page = path.resolve(process.argv[2]);

(async () => {
    const browser = await Browser.open(path.join(path.dirname(page), "browser-bench"));
    try {
        for (const query of ["", "?simd=0"])
            for (const scene of ["race", "drone"])
                for (const hash of ["&method=none", "&quality=draft", "", "&quality=fine", "&method=timemask&quality=fine", "&method=reconstruct"]) {
                    await browser.go("about:blank");
                    await browser.go("file://" + page + query + "#paused=1&scene=" + scene + hash);
                    await browser.until("shownFrame && !changing && engines.every(e => e.busy === 0)", 60);
                    const us = await browser.runAsync(`const done = arguments[0]; (async () => {
                        const best = new Array(60).fill(1e9);
                        for (let round = 0; round < 3; round++)
                            for (let n = 0; n < 60; n += 5) {
                                const answer = await engines[0].ask("draw", { frame: n });
                                if (round > 0) best[n] = Math.min(best[n], answer.stats.us);
                            }
                        const drawn = best.filter(us => us < 1e9);
                        done(drawn.reduce((a, b) => a + b) / drawn.length);
                    })();`);
                    console.log((query === "" ? "simd   " : "scalar ") + scene.padEnd(6) + (hash || "&quality=balanced").slice(1).replace("&", " ").padEnd(32)
                        + (us / 1000).toFixed(1).padStart(8) + " ms  " + (1e6 / us).toFixed(1).padStart(7) + " frames per second");
                }
    } finally {
        await browser.close();
    }
})().catch(error => { console.error(error.message || error); process.exit(1); });
