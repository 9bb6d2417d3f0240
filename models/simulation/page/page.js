"use strict";
const data = JSON.parse(document.getElementById("data").textContent);
const $ = (id) => document.getElementById(id);
const NS = "http://www.w3.org/2000/svg";
const WIDTH = 1240, LEFT = 92, RIGHT = 30;
const last = Math.max(0, ...data.trains.map((train) => train.m.length - 1));
const x = (second) => LEFT + (WIDTH - LEFT - RIGHT) * second / Math.max(1, data.end);
let at = 0, timer = null;

function make(parent, name, given, text) {
  const node = document.createElementNS(NS, name);
  for (const [key, value] of Object.entries(given)) node.setAttribute(key, value);
  if (text !== undefined) {
    const inner = name === "text" ? node : node.appendChild(document.createElementNS(NS, "title"));
    inner.textContent = text;
  }
  return parent.appendChild(node);
}
function size(svg, height) { svg.setAttribute("width", WIDTH); svg.setAttribute("height", height); svg.setAttribute("viewBox", `0 0 ${WIDTH} ${height}`); }
function clock(second) {
  const two = (number) => String(number).padStart(2, "0");
  return `${Math.floor(second / 3600)}:${two(Math.floor(second / 60) % 60)}:${two(second % 60)}`;
}
function ticks(svg, top, bottom) {
  const every = [60, 300, 600, 1800, 3600, 14400].find((step) => data.end / step <= 14) || 36000;
  for (let second = 0; second <= data.end; second += every) {
    make(svg, "line", { class: "grid", x1: x(second), x2: x(second), y1: top, y2: bottom });
    make(svg, "text", { class: "axis", x: x(second), y: top - 5, "text-anchor": "middle" }, clock(second).slice(0, -3));
  }
}

// ---- the track
const track = $("track"), rails = [], tags = [];
size(track, data.track.height + 6);
data.track.lines.forEach((line, index) => {
  rails.push(make(track, "polyline", { class: "rail", points: line.join(" ") }, data.blocks[data.of[index]]));
});
for (const [px, py, name] of data.track.ends) make(track, "line", { class: "end", x1: px, x2: px, y1: py - 5, y2: py + 5 }, name);
for (const [px, py, name] of data.track.points) make(track, "circle", { class: "point", cx: px, cy: py, r: 2.6 }, name);
const roads = data.roads.map((road) => road.places.map(([segment, share]) => {
  const [px, py] = along(data.track.lines[segment], share / 1000);
  return make(track, "path", { class: "road", d: `M${px - 4} ${py - 6}L${px + 4} ${py + 6}M${px - 4} ${py + 6}L${px + 4} ${py - 6}` }, road.name);
}));
data.trains.forEach((train) => {
  const group = make(track, "g", {});
  make(group, "circle", { r: 5, fill: train.colour, stroke: "#fff" }, train.name);
  make(group, "text", { class: "tag", y: -8 }, train.name.replace(/^T0?/, ""));
  tags.push(group);
});
function along(line, share) {
  const parts = [];
  let whole = 0;
  for (let i = 0; i + 3 < line.length; i += 2) {
    const length = Math.hypot(line[i + 2] - line[i], line[i + 3] - line[i + 1]);
    parts.push(length); whole += length;
  }
  let left = whole * share;
  for (let i = 0; i < parts.length; i++) {
    if (left <= parts[i] || i === parts.length - 1) {
      const part = parts[i] ? left / parts[i] : 0;
      return [line[2 * i] + (line[2 * i + 2] - line[2 * i]) * part, line[2 * i + 1] + (line[2 * i + 3] - line[2 * i + 1]) * part];
    }
    left -= parts[i];
  }
  return [line[0], line[1]];
}

// ---- time and distance
const lines = $("lines"), HIGH = 430, HEAD = 18;
size(lines, HIGH + 8);
const y = (m) => HEAD + (HIGH - HEAD) * m / 1000 / data.km;
ticks(lines, HEAD, HIGH);
for (let km = 0; km <= data.km; km += data.km > 20 ? 5 : data.km > 4 ? 1 : 0.5) {
  make(lines, "line", { class: "grid", x1: LEFT, x2: WIDTH - RIGHT, y1: y(km * 1000), y2: y(km * 1000) });
  make(lines, "text", { class: "axis", x: LEFT - 8, y: y(km * 1000) + 3, "text-anchor": "end" }, `${km} km`);
}
for (const road of data.roads) {
  const heights = road.places.map(([, , m]) => y(m)).sort((a, b) => a - b).filter((height, i, all) => !i || height - all[i - 1] > 6);
  for (const height of heights) {
    make(lines, "line", { class: "road", x1: LEFT, x2: WIDTH - RIGHT, y1: height, y2: height });
    for (const [from, to] of road.closings) make(lines, "rect", { class: "closed", x: x(from), y: height - 3, width: Math.max(0.6, x(to) - x(from)), height: 6 }, `${road.name}: closed ${clock(from)} to ${clock(to)}`);
  }
  make(lines, "text", { class: "axis road", x: LEFT + 4, y: heights[0] - 5 }, road.name);
}
const paths = data.trains.map((train) => {
  let path = "";
  train.m.forEach((m, i) => {
    if (i && i + 1 < train.m.length && m === train.m[i - 1] && m === train.m[i + 1]) return;
    const jumps = i && Math.abs(m - train.m[i - 1]) > 70 * data.every;
    path += `${i && !jumps ? "L" : "M"}${x((i + 1) * data.every).toFixed(1)} ${y(m).toFixed(1)}`;
  });
  const end = train.m.length - 1;
  if (end >= 0) make(lines, "text", { x: WIDTH - RIGHT + 3, y: y(train.m[end]) + 4, fill: train.colour, style: `fill:${train.colour};font-size:9px` }, train.name);
  return make(lines, "path", { d: path, stroke: train.colour }, train.name);
});
data.events.forEach(([second, kind, who, text]) => {
  const train = data.trains.find((each) => each.name === who);
  if (kind !== "fault" || !train || !train.m.length) return;
  const i = Math.min(train.m.length - 1, Math.max(0, Math.floor(second / data.every) - 1));
  make(lines, "circle", { class: "fault", cx: x(second), cy: y(train.m[i]), r: 2.6 }, `${clock(second)} ${who}: ${text}`);
});
const lineCursor = make(lines, "line", { class: "cursor", y1: HEAD, y2: HIGH });

// ---- blocks
const chart = $("chart"), ROW = 9, row = new Map(data.shown.map((block, i) => [block, i]));
size(chart, HEAD + ROW * data.shown.length + 6);
data.shown.forEach((block, i) => {
  make(chart, "text", { x: LEFT - 6, y: HEAD + ROW * i + 7.4, "text-anchor": "end", style: "font-size:8px" }, data.blocks[block].replace(/^B:/, "").slice(0, 20));
  if (i % 2) make(chart, "rect", { x: LEFT, y: HEAD + ROW * i, width: WIDTH - LEFT - RIGHT, height: ROW, fill: "#f8f9fa" });
});
ticks(chart, HEAD, HEAD + ROW * data.shown.length);
data.stays.forEach(([block, who, there, from, to]) => {
  if (!row.has(block)) return;
  const name = who < 0 ? "lost since the restart" : there ? `${data.trains[who].name} is in it` : `held for ${data.trains[who].name}`;
  const given = { x: x(from), y: HEAD + ROW * row.get(block) + (there ? 2 : 0.5), width: Math.max(0.6, x(to) - x(from)), height: there ? ROW - 4 : ROW - 1 };
  make(chart, "rect", { ...given, class: who < 0 ? "lost" : there ? "there" : "held", fill: who < 0 ? "#555" : data.trains[who].colour }, `${data.blocks[block]}: ${name}, ${clock(from)} to ${clock(to)}`);
});
const chartCursor = make(chart, "line", { class: "cursor", y1: HEAD, y2: HEAD + ROW * data.shown.length });

// ---- events and trains
const items = data.events.map(([second, kind, who, text], i) => {
  const item = document.createElement("li"), time = document.createElement("b");
  time.textContent = clock(second);
  item.className = kind;
  item.append(time, `${who} ${text}`);
  item.addEventListener("click", () => go(Math.ceil(second / data.every) - 1));
  return $("events").appendChild(item);
});
const cells = data.trains.map((train, i) => {
  const line = document.querySelector(`tr[data-train="${i}"]`);
  line.querySelector("i").style.background = train.colour;
  return line.querySelectorAll("td");
});

function go(to) {
  at = Math.max(0, Math.min(last, to));
  const second = (at + 1) * data.every;
  const taken = new Map();
  for (const [block, who, there, from, until] of data.stays) {
    if (from <= second && second < until && !(taken.has(block) && taken.get(block)[1])) taken.set(block, [who, there]);
  }
  rails.forEach((rail, i) => {
    const here = taken.get(data.of[i]);
    rail.setAttribute("class", `rail${here ? here[0] < 0 ? " lost" : here[1] ? " there" : " held" : ""}`);
    rail.style.stroke = here && here[0] >= 0 ? data.trains[here[0]].colour : "";
  });
  data.roads.forEach((road, i) => {
    const closed = road.closings.some(([from, to]) => from <= second && second < to);
    for (const mark of roads[i]) mark.setAttribute("class", closed ? "road shut" : "road");
  });
  data.trains.forEach((train, i) => {
    const [px, py] = along(data.track.lines[train.segment[at] || 0], (train.share[at] || 0) / 1000);
    tags[i].setAttribute("transform", `translate(${px.toFixed(1)} ${py.toFixed(1)})`);
    cells[i][0].textContent = data.phases[train.phase[at]] || "";
    cells[i][1].textContent = train.kmh[at] ?? "";
    cells[i][2].textContent = data.blocks[data.of[train.segment[at] || 0]];
  });
  for (const cursor of [lineCursor, chartCursor]) { cursor.setAttribute("x1", x(second)); cursor.setAttribute("x2", x(second)); }
  let now = -1;
  data.events.forEach(([when], i) => { if (when <= second) now = i; });
  items.forEach((item, i) => { item.classList.toggle("past", i <= now); item.classList.toggle("now", i === now); });
  if (now >= 0) $("events").scrollTop = Math.max(0, items[now].offsetTop - $("events").clientHeight / 2);
  $("slider").value = at;
  $("where").textContent = clock(second);
}
function seek(way, kind) {
  const second = (at + 1) * data.every;
  const found = data.events.filter(([when, what]) => (kind ? what === kind : true) && (way > 0 ? when > second : when <= second - data.every));
  if (found.length) go(Math.ceil((way > 0 ? found[0] : found[found.length - 1])[0] / data.every) - 1);
}
function play() {
  if (timer) { clearInterval(timer); timer = null; } else timer = setInterval(() => { if (at >= last) play(); else go(at + 1); }, 80);
  $("play").textContent = timer ? "stop" : "play";
}
const keys = {
  ArrowLeft: (shift) => go(at - (shift ? 60 / data.every : 1)), ArrowRight: (shift) => go(at + (shift ? 60 / data.every : 1)),
  Home: () => go(0), End: () => go(last), " ": play, n: () => seek(1), p: () => seek(-1), f: () => seek(1, "fault"),
};
document.addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.altKey || event.metaKey || !(event.key in keys)) return;
  event.preventDefault();
  keys[event.key](event.shiftKey);
});
$("slider").max = last;
$("slider").addEventListener("input", () => go(Number($("slider").value)));
for (const [id, key] of [["first", "Home"], ["back", "ArrowLeft"], ["on", "ArrowRight"], ["last", "End"], ["play", " "], ["fault", "f"]]) $(id).addEventListener("click", () => keys[key](false));
for (const svg of [lines, chart]) svg.addEventListener("click", (event) => {
  const box = svg.getBoundingClientRect();
  go(Math.round((event.clientX - box.left - LEFT) / (WIDTH - LEFT - RIGHT) * data.end / data.every) - 1);
});
go(0);
