"use strict";
// Shows one second of the data at a time; everything shown stands in it.
const { line, moments } = JSON.parse(document.getElementById("data").textContent);
const SAYS = { alarm: "ALARM: train near", caution: "Caution: train approaches", fault: "FAULT: do not rely on this",
  normal: "No train approaches" };
const NEAR_M = 3500, LEFT = 12, WIDTH = 320, TRACK = 58;
const byId = (id) => document.getElementById(id);
let now = 0, timer = null;

function put(svg, name, given, text) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(given)) made.setAttribute(key, value);
  if (text !== undefined) made.textContent = text;
  svg.append(made);
}

function draw(svg, fromM, toM, moment, near) {
  const x = (m) => LEFT + WIDTH * (Math.max(fromM, Math.min(toM, m)) - fromM) / (toM - fromM);
  const isIn = (m) => fromM <= m && m <= toM;
  svg.replaceChildren();
  for (const [, begin, end] of line.sections)
    if (end >= fromM && begin <= toM)
      put(svg, "rect", { class: "section", x: x(begin), y: TRACK - 16, width: Math.max(2, x(end) - x(begin)), height: 32 });
  put(svg, "line", { class: "track", x1: x(Math.max(0, fromM)), x2: x(Math.min(line.length_m, toM)), y1: TRACK, y2: TRACK });
  for (const [begin, end] of line.tunnels)
    if (end >= fromM && begin <= toM)
      put(svg, "line", { class: "tunnel", x1: x(begin), x2: x(end), y1: TRACK, y2: TRACK });
  for (const [number, [name, at]] of line.stations.entries())
    if (isIn(at)) {
      put(svg, "circle", { class: "station", cx: x(at), cy: TRACK, r: 4 });
      if (near || number % 2 === 0)
        put(svg, "text", { x: x(at), y: 100, "text-anchor": near ? "middle" : at === 0 ? "start" : at === line.length_m ? "end" : "middle" }, name);
    }
  if (near)
    for (const way of [-line.caution_m, -line.alarm_m, line.alarm_m, line.caution_m]) {
      const at = moment.own_m + way;
      put(svg, "line", { class: "limit", x1: x(at), x2: x(at), y1: 20, y2: 86 });
      put(svg, "text", { x: x(at), y: 12, "text-anchor": "middle" }, `${Math.abs(way)} m`);
    }
  if (moment.gps === "fix")
    put(svg, "path", { class: "worker", d: `M${x(moment.own_m)},${TRACK + 3} l-5,12 h10 z m-4,0 a4,4 0 1 1 8,0 z` });
  for (const train of moment.trains) {
    if (!isIn(train.at_m)) continue;
    const at = x(train.at_m), point = train.way === "down" ? 9 : -9;
    const shape = train.way === "" ? `M${at - 6},${TRACK - 15} h12 v9 h-12 z`
      : `M${at + point},${TRACK - 11} l${-point},-6 h${-point / 2} v12 h${point / 2} z`;
    put(svg, "path", { class: `train ${train.tone}${train.is_placed ? "" : " unplaced"}`, d: shape });
    if (near) put(svg, "text", { class: "named", x: Math.max(24, Math.min(320, at)), y: TRACK - 19, "text-anchor": "middle" }, train.number);
  }
}

function nearest(moment, way) {
  const rank = { alarm: 0, caution: 1, normal: 2 };
  const found = moment.trains.filter((train) => (train.way || way) === way);
  const far = (train) => train.distance_m ?? Math.abs(train.at_m - moment.own_m);
  return found.sort((one, other) => rank[one.tone] - rank[other.tone] || far(one) - far(other))[0];
}

function showTrain(moment, way) {
  const box = byId(way), train = nearest(moment, way);
  const set = (name, text) => { box.querySelector(`.${name}`).textContent = text; };
  box.className = train && train.tone !== "normal" ? train.tone : "";
  set("number", train ? train.number : "–");
  set("section", train ? train.section : moment.tone === "fault" ? "not known" : "no train");
  const late = train && (train.late_min > 0 ? `${train.late_min} min late` : "on time");
  const speed = train && (train.speed_km_h === null ? "no speed" : `${train.speed_km_h} km/h`);
  set("small", train ? `${late} · ${speed}` : "");
  set("distance", train ? (train.distance_m === null ? "no GPS" : `${train.distance_m} m`) : "");
  set("way", train && train.departs ? "past, runs away" : "");
}

function lamp(id, text, isBad) {
  byId(id).textContent = text;
  byId(id).parentElement.classList.toggle("bad", isBad);
}

function show(second) {
  now = Math.max(0, Math.min(moments.length - 1, second));
  const moment = moments[now];
  lamp("battery", `${moment.battery} %`, moment.battery < 10);
  lamp("network", moment.network, moment.network === "none");
  lamp("gps", moment.gps, moment.gps === "none");
  lamp("unit", moment.unit, moment.unit !== "works");
  byId("tone").className = moment.tone;
  byId("tone").firstChild.textContent = SAYS[moment.tone];
  byId("why").textContent = [...moment.problems, ...moment.notices].join(" · ");
  showTrain(moment, "up");
  showTrain(moment, "down");
  draw(byId("near"), moment.own_m - NEAR_M, moment.own_m + NEAR_M, moment, true);
  draw(byId("wide"), 0, line.length_m, moment, false);
  byId("own").textContent = moment.own;
  byId("clock").textContent = moment.clock;
  byId("slider").value = now;
}

function play() {
  if (timer === null) timer = setInterval(() => (now < moments.length - 1 ? show(now + 1) : play()), 1000 / 8);
  else { clearInterval(timer); timer = null; }
  byId("play").textContent = timer === null ? "play" : "pause";
}

const STEPS = { ArrowRight: 1, ArrowLeft: -1, PageDown: 60, PageUp: -60 };
document.addEventListener("keydown", (event) => {
  if (event.key in STEPS) show(now + STEPS[event.key]);
  else if (event.key === "Home") show(0);
  else if (event.key === "End") show(moments.length - 1);
  else if (event.key === " ") play();
  else return;
  event.preventDefault();
});
byId("back").onclick = () => show(now - 1);
byId("on").onclick = () => show(now + 1);
byId("play").onclick = play;
byId("slider").oninput = (event) => show(Number(event.target.value));
const asked = /^#t=(\d+)$/.exec(location.hash);
show(asked ? Number(asked[1]) : 0);
