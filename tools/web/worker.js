// SPDX-License-Identifier: MIT
// worker.js - the module in a worker: messages in, pictures and texts out. A trap in the module ends it; the page then
// starts another worker. Answers: { id, status, said: { out, err }, ... }.

let wasm = null, trouble = "";

const memory = () => new Uint8Array(wasm.memory.buffer);

function textAt(address) {
    const m = memory();
    let end = address;
    while (m[end] !== 0) end++;
    return new TextDecoder().decode(m.slice(address, end));
}

// A command line, word by word.
function say(words) {
    wasm.web_begin();
    for (const word of words) {
        const bytes = new TextEncoder().encode(word + "\0"), at = wasm.web_word(bytes.length);
        if (at === 0) throw new Error("too many words");
        memory().set(bytes, at);
    }
}

function file(name) {
    say([name]);
    const at = wasm.web_find();
    return at === 0 ? null : memory().slice(at, at + wasm.web_size());
}

function said() {
    const text = name => new TextDecoder().decode(file(name) || new Uint8Array(0));
    const both = { out: text(".out"), err: trouble + text(".err") };
    trouble = "";
    wasm.web_clear();
    return both;
}

function json(call) {
    call();
    return JSON.parse(textAt(wasm.web_text()));
}

// The files are there while `call` runs; its status.
function withFiles(files, call) {
    let status = 0;
    for (const f of files) {
        say([f.name]);
        const at = wasm.web_make(f.bytes.byteLength);
        if (at === 0) {
            status = 1;
            trouble = "smear: " + f.name + ": out of memory (" + f.bytes.byteLength + " bytes)\n";
            break;
        }
        memory().set(new Uint8Array(f.bytes), at);
    }
    status = status || call();
    for (const f of files) {
        say([f.name]);
        wasm.web_remove();
    }
    return status;
}

function picture(left) {
    const at = wasm.web_picture(left);
    return memory().slice(at, at + wasm.web_width() * wasm.web_height() * 4).buffer;
}

const commands = {
    boards: () => ({ boards: json(wasm.web_boards) }),
    open(m) {
        const status = withFiles(m.files, () => { say(m.words); return wasm.web_open(m.board); });
        return status === 0 ? { status, scene: json(wasm.web_scene) } : { status };
    },
    change(m) {
        say(m.words);
        const status = wasm.web_change(m.board);
        return status === 0 ? { status, scene: json(wasm.web_scene) } : { status };
    },
    turn(m) {
        if (m.straight) wasm.web_straight();
        return { status: wasm.web_turn(m.frame, m.yaw, m.pitch, m.factor, m.spin) };
    },
    draw(m) {
        const status = wasm.web_draw(m.frame, 1);
        if (status !== 0) return { status };
        return { status, frame: m.frame, width: wasm.web_width(), height: wasm.web_height(), main: picture(0), left: picture(1),
                 stats: json(wasm.web_stats) };
    },
    convert(m) {
        const status = withFiles(m.files, () => { say(m.words); return wasm.web_convert(); });
        const bytes = status === 0 ? file(m.output) : null;
        say([m.output]);
        wasm.web_remove();
        return { status, bytes: bytes && bytes.buffer };
    },
    gif(m) {
        let status = wasm.web_film_begin();
        for (let i = 0; i < m.count && status === 0; i++) {
            status = wasm.web_draw(m.first + i, 0) || wasm.web_film_add(m.delay);
            postMessage({ id: m.id, progress: (i + 1) / m.count });
        }
        status = status || wasm.web_film_end();
        const bytes = status === 0 ? file("smear.gif") : null;
        say(["smear.gif"]);
        wasm.web_remove();
        return { status, bytes: bytes && bytes.buffer };
    },
};

async function start(m) {
    const module = m.module || await WebAssembly.compile((await filesOf(m.unlzma, m.text))[m.simd ? 1 : 0]);
    const instance = await WebAssembly.instantiate(module, { page: { clock_us: () => performance.now() * 1000 } });
    wasm = instance.exports;
    return { status: 0, module };
}

onmessage = async event => {
    const m = event.data;
    let answer;
    try {
        answer = m.command === "start" ? await start(m) : commands[m.command](m);
        const words = wasm ? said() : { out: "", err: "" };
        answer.out = words.out;
        answer.err = words.err;
    } catch (error) {
        answer = { dead: true, status: 1, err: String(error && error.message || error) };
    }
    answer.id = m.id;
    const parts = [answer.main, answer.left, answer.bytes].filter(part => part);
    postMessage(answer, parts);
};
