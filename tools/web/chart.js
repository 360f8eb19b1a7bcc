// SPDX-License-Identifier: MIT
// chart.js - speed against accuracy, with the present setting marked.

const CURVES = METHODS.filter(m => m.curve).map(m => [m.name, m.curve, m.color]);

const ANY = 4;                          // quality, of methods that have but one

// [{ setting, method, index, quality, label, cost, rmse }] of chart.csv; what the page does not offer is left out.
function readChart(text) {
    const rows = text.trim().split("\n").slice(1).map(line => {
        const [setting, cost, rmse] = line.split(","), [method, at, more] = setting.split(" "), index = methodNamed(method);
        if (index < 0 || more || !(cost > 0) || !(rmse > 0)) return null;
        const samples = METHODS[index].samples, quality = method === "auto" ? QUALITIES.indexOf(at) : at ? samples.indexOf(+at) + 1 || -1 : samples[0] ? -1 : ANY;
        return method !== "auto" && at && !(+at > 0) ? null : { setting, method, index, quality, label: at || METHODS[index].label, cost: +cost, rmse: +rmse };
    });
    return rows.filter(r => r);
}

const chartRows = readChart(chartText), sharpRow = chartRows.find(r => r.method === "none");

function current() {
    const method = S.shutter === 0 ? 0 : S.method;
    return chartRows.find(r => r.index === method && (r.quality === (r.method === "auto" ? S.quality : sampleQuality(S.quality)) || r.quality === ANY));
}

function svg(name, attributes, text) {
    const e = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const key in attributes) e.setAttribute(key, attributes[key]);
    if (text !== undefined) e.textContent = text;
    return e;
}

const LEFT = 52, RIGHT = 606, TOP = 14, BOTTOM = 352;
const COST = [0.85, Math.max(45, ...chartRows.map(r => 1.2 * r.cost))];
const ERROR = [Math.min(0.3, ...chartRows.map(r => 0.8 * r.rmse)), Math.max(16, ...chartRows.map(r => 1.2 * r.rmse))];
const toX = cost => LEFT + (RIGHT - LEFT) * Math.log(cost / COST[0]) / Math.log(COST[1] / COST[0]);
const toY = error => BOTTOM - (BOTTOM - TOP) * Math.log(error / ERROR[0]) / Math.log(ERROR[1] / ERROR[0]);

function buildChart() {
    const c = $("chart");
    for (const v of [1, 2, 5, 10, 20, 40]) {
        c.append(svg("line", { class: "axis", x1: toX(v), x2: toX(v), y1: TOP, y2: BOTTOM }), svg("text", { x: toX(v), y: BOTTOM + 17, "text-anchor": "middle" }, v + "\u00d7"));
    }
    for (const v of [0.5, 1, 2, 5, 10])
        c.append(svg("line", { class: "axis", x1: LEFT, x2: RIGHT, y1: toY(v), y2: toY(v) }), svg("text", { x: LEFT - 7, y: toY(v) + 4, "text-anchor": "end" }, v));
    c.append(svg("text", { x: (LEFT + RIGHT) / 2, y: BOTTOM + 38, "text-anchor": "middle" }, "cost of a frame, relative to the sharp one"));
    const middle = (TOP + BOTTOM) / 2;
    c.append(svg("text", { x: 14, y: middle, "text-anchor": "middle", transform: "rotate(-90 14 " + middle + ")" }, "error against the truth, in codes of 255"));
    let legend = 0;
    CURVES.forEach(([method, label, color]) => {
        const rows = chartRows.filter(r => r.method === method).sort((a, b) => a.cost - b.cost);
        if (rows.length === 0) return;
        c.append(svg("polyline", { points: rows.map(r => toX(r.cost) + "," + toY(r.rmse)).join(" "), fill: "none", stroke: color, "stroke-width": method === "auto" ? 3 : 1.6 }));
        c.append(svg("circle", { cx: RIGHT - 178, cy: TOP + 12 + legend, r: 5, fill: color }), svg("text", { x: RIGHT - 166, y: TOP + 16 + legend }, label));
        legend += 17;
        rows.forEach(r => addPoint(c, r, color));
    });
    if (sharpRow) addPoint(c, sharpRow, "#ffffff");
    c.append(svg("circle", { id: "ring", r: 13, fill: "none", stroke: "#ffffff", "stroke-width": 2.5, "pointer-events": "none" }));
    const rows = [["setting", "cost", "error"], ...chartRows.map(r => [r.setting, r.cost.toFixed(2) + "\u00d7", r.rmse.toFixed(2)])];
    const table = document.createElement("table");
    rows.forEach((row, i) => { const tr = table.insertRow(); row.forEach(v => { const td = document.createElement(i ? "td" : "th"); td.textContent = v; tr.append(td); }); });
    $("chartTable").append(table);
}

function addPoint(c, r, color) {
    const usable = r.quality >= 0, x = toX(r.cost), y = toY(r.rmse);
    const point = svg("circle", { cx: x, cy: y, r: usable ? 6 : 3.5, fill: color, class: usable ? "point" : "" });
    const title = r.setting + ": " + r.cost.toFixed(1) + " times the sharp frame, error " + r.rmse.toFixed(2) + " codes";
    point.append(svg("title", {}, title));
    if (usable) {
        const pick = () => set({ method: r.index, quality: r.quality === ANY ? S.quality : r.quality, shutter: S.shutter || 180 });
        point.setAttribute("tabindex", 0);
        point.setAttribute("role", "button");
        point.setAttribute("aria-label", title);
        point.onclick = pick;
        point.onkeydown = e => { if (e.key === "Enter" || e.key === " ") { e.preventDefault(); e.stopPropagation(); pick(); } };
    }
    c.append(point);
    const isLeft = r.label === "balanced", below = r.label === "fine" || r.label === "balanced";         // the two lie close to each other
    if (usable && (r.method === "accumulate" || r.method === "auto" || r.method === "none"))
        c.append(svg("text", { x: isLeft ? x - 14 : x + (below ? 14 : 10), y: below ? y + 20 : y - 8, "text-anchor": isLeft ? "end" : "start" }, r.label));
}

function showChart() {
    const r = current();
    $("ring").setAttribute("visibility", r ? "visible" : "hidden");
    if (!r || !sharpRow) { $("chartText").textContent = "Now: a setting that has not been measured."; return; }
    $("ring").setAttribute("cx", toX(r.cost));
    $("ring").setAttribute("cy", toY(r.rmse));
    const times = sharpRow.rmse / r.rmse, by = times.toFixed(times < 3 ? 1 : 0);
    $("chartText").textContent = r === sharpRow ? "Now: the sharp frame, " + sharpRow.rmse.toFixed(1) + " codes from what a camera would see."
        : "Now: " + r.setting + ", " + r.cost.toFixed(1) + " times the instructions of the sharp frame, " + by + " times nearer to the truth.";
}
