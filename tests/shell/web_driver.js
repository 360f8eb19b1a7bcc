// SPDX-License-Identifier: MIT
// web_driver.js - headless Chromium through chromedriver: the WebDriver protocol, by HTTP, on node alone.
"use strict";
const http = require("http"), fs = require("fs"), path = require("path"), { spawn } = require("child_process");

const ELEMENT = "element-6066-11e4-a52e-4f735466cecf";

function request(port, method, where, body) {
    return new Promise((resolve, reject) => {
        const text = body === undefined ? "" : JSON.stringify(body);
        const r = http.request({ port, host: "127.0.0.1", method, path: where,
            headers: { "content-type": "application/json", "content-length": Buffer.byteLength(text) } }, answer => {
            const parts = [];
            answer.on("data", part => parts.push(part));
            answer.on("end", () => {
                let value;
                try { value = JSON.parse(Buffer.concat(parts)).value; } catch (e) { reject(e); return; }
                if (value && value.error) reject(new Error(value.error + ": " + value.message.split("\n")[0]));
                else resolve(value);
            });
        });
        r.setTimeout(120000, () => r.destroy(new Error("the browser does not answer")));
        r.on("error", reject);
        r.end(text);
    });
}

// A driver on a port of its own choice.
function startDriver() {
    return new Promise((resolve, reject) => {
        const driver = spawn("chromedriver", ["--port=0"], { stdio: ["ignore", "pipe", "ignore"] });
        let said = "";
        driver.on("error", reject);
        driver.on("exit", () => reject(new Error("chromedriver ended: " + said)));
        driver.stdout.on("data", part => {
            said += part;
            const found = said.match(/started successfully on port (\d+)/);
            if (found) resolve({ driver, port: +found[1] });
        });
    });
}

class Browser {
    // folder: of its profile and of downloads. wasm: false: none. args: more of Chromium's.
    static async open(folder, { width = 1280, height = 900, args = [] } = {}) {
        const b = new Browser();
        Object.assign(b, await startDriver());
        b.folder = path.resolve(folder);
        b.downloads = path.join(b.folder, "downloads");
        fs.rmSync(b.folder, { recursive: true, force: true });
        fs.mkdirSync(b.downloads, { recursive: true });
        const list = ["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--disable-quic", "--no-first-run",
            "--disable-background-networking", "--disable-component-update", "--disable-sync", "--hide-scrollbars",
            "--force-device-scale-factor=1", "--window-size=" + width + "," + height, "--user-data-dir=" + path.join(b.folder, "profile"), ...args];
        try {
            const session = await request(b.port, "POST", "/session", { capabilities: { alwaysMatch: { browserName: "chrome",
                "goog:loggingPrefs": { browser: "ALL" }, timeouts: { script: 110000, pageLoad: 60000 },
                "goog:chromeOptions": { args: list, prefs: { "download.default_directory": b.downloads, "download.prompt_for_download": false,
                    "profile.default_content_setting_values.automatic_downloads": 1 } } } } });
            b.at = "/session/" + session.sessionId;
        } catch (e) {
            b.driver.kill();
            throw e;
        }
        return b;
    }
    async close() {
        try { await request(this.port, "DELETE", this.at); } catch (e) { /* it has gone already */ }
        this.driver.removeAllListeners("exit");
        this.driver.kill();
        fs.rmSync(path.join(this.folder, "profile"), { recursive: true, force: true, maxRetries: 5 });
    }
    go(url) { return request(this.port, "POST", this.at + "/url", { url }); }
    run(script, ...args) { return request(this.port, "POST", this.at + "/execute/sync", { script, args }); }
    runAsync(script, ...args) { return request(this.port, "POST", this.at + "/execute/async", { script, args }); }
    log() { return request(this.port, "POST", this.at + "/se/log", { type: "browser" }); }
    async element(css) { return (await request(this.port, "POST", this.at + "/element", { using: "css selector", value: css }))[ELEMENT]; }
    async click(css) { return request(this.port, "POST", this.at + "/element/" + await this.element(css) + "/click", {}); }
    async type(css, text) { return request(this.port, "POST", this.at + "/element/" + await this.element(css) + "/value", { text }); }
    async text(css) { return request(this.port, "GET", this.at + "/element/" + await this.element(css) + "/text"); }
    resize(width, height) { return request(this.port, "POST", this.at + "/window/rect", { width, height }); }
    async devtools(cmd, params) { return request(this.port, "POST", this.at + "/goog/cdp/execute", { cmd, params }); }
    // From x, y beside the middle of the element.
    async drag(css, dx, dy, x = 0, y = 0) {
        const origin = { [ELEMENT]: await this.element(css) };
        return request(this.port, "POST", this.at + "/actions", { actions: [{ type: "pointer", id: "mouse", parameters: { pointerType: "mouse" }, actions: [
            { type: "pointerMove", duration: 0, x, y, origin }, { type: "pointerDown", button: 0 },
            { type: "pointerMove", duration: 200, x: x + dx, y: y + dy, origin }, { type: "pointerUp", button: 0 }] }] });
    }
    async picture(file, whole) {
        let data;
        if (whole) {
            const size = (await this.devtools("Page.getLayoutMetrics", {})).cssContentSize;
            data = (await this.devtools("Page.captureScreenshot", { format: "png", captureBeyondViewport: true,
                clip: { x: 0, y: 0, width: size.width, height: size.height, scale: 1 } })).data;
        } else {
            data = await request(this.port, "GET", this.at + "/screenshot");
        }
        fs.writeFileSync(file, Buffer.from(data, "base64"));
    }
    // The value of a script once it is true; null after `seconds`.
    async until(script, seconds = 30) {
        const end = Date.now() + seconds * 1000;
        for (;;) {
            const value = await this.run("return (" + script + ")");
            if (value) return value;
            if (Date.now() > end) return null;
            await new Promise(done => setTimeout(done, 60));
        }
    }
}

// Runs the tests whose names contain `filter`, { name: function }, and ends the program. Each fails alone; `failed` is told its number.
async function runTests(tests, open, failed = () => {}, filter = "") {
    let passed = 0, count = 0;
    const fails = (name, why) => { count++; console.log("FAILED: " + name + "\n    " + why); };
    try {
        const browser = await open();
        for (const name in tests) {
            if (!name.includes(filter)) continue;
            try {
                await tests[name]();
                passed++;
            } catch (error) {
                fails(name, error.message || error);
                try { await failed(count); } catch (e) { /* the browser has gone */ }
            }
        }
        await browser.close();
    } catch (error) {
        fails("the browser", error.stack || error);
    }
    console.log(passed + " passed, " + count + " failed");
    process.exit(count > 0 ? 1 : 0);
}

function check(truth, what) {
    if (!truth) throw new Error(what);
}

function equal(a, b, what) {
    if (a !== b) throw new Error(what + ": " + JSON.stringify(a) + ", not " + JSON.stringify(b));
}

module.exports = { Browser, runTests, check, equal };
