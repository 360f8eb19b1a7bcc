// SPDX-License-Identifier: MIT
// begin.js - unpacks the page's scripts and starts them, or says why it cannot.
"use strict";
const scriptStart = performance.now();
const packed = id => document.getElementById(id).textContent.trim();
let pageTexts = [];                     // app.js, worker.js, chart.csv

function fatal(text) {
    document.getElementById("fatal").textContent = text;
    document.getElementById("main").hidden = true;
}

if (typeof WebAssembly !== "object" || typeof Worker !== "function")
    fatal("This browser has no WebAssembly, or it is switched off. The page runs a C library, so it has nothing to show here. "
        + "Any browser since 2018 has it; or run the library itself: make && build/smear view.");
else
    filesOf(packed("unlzma"), packed("texts")).then(files => {
        pageTexts = files.map(f => new TextDecoder().decode(f));
        document.head.append(Object.assign(document.createElement("script"), { textContent: pageTexts[0] }));
    }).catch(error => fatal("The page does not start: " + (error && error.message || error)));
