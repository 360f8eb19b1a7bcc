// SPDX-License-Identifier: MIT
// begin.js - unpacks the page's scripts and starts them, or says why it cannot.
"use strict";
const scriptStart = performance.now();
const packed = id => document.getElementById(id).textContent.trim();
let chartText = "", workerText = "";

function fatal(text) {
    document.getElementById("fatal").textContent = text;
    document.getElementById("main").hidden = true;
}

if (typeof WebAssembly !== "object" || typeof Worker !== "function")
    fatal("This browser has no WebAssembly, or it is switched off. The page runs a C library, so it has nothing to show here. "
        + "Any browser since 2018 has it; or run the library itself: make && build/smear view.");
else
    filesOf(packed("unlzma"), packed("texts")).then(files => {
        const texts = files.map(f => new TextDecoder().decode(f));
        [chartText, workerText] = texts;
        document.head.append(Object.assign(document.createElement("script"), { textContent: "\"use strict\";\n" + texts.slice(2).join("") }));
    }).catch(error => fatal("The page does not start: " + (error && error.message || error)));
