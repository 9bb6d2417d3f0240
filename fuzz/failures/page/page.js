"use strict";
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const get = (id) => document.getElementById(id);
  const items = [...document.querySelectorAll("#steps li")];
  const svg = document.querySelector(".diagram svg");
  const cursor = get("cursor");
  const left = Number(cursor.getAttribute("x"));
  const column = Number(cursor.getAttribute("width"));
  const top = Number(cursor.getAttribute("y"));
  const labels = [...document.querySelectorAll("#labels text")];
  let step = -1;

  // The state after a step is the start with the changes of every step up to it.
  function stateAt(wanted) {
    const state = { trains: {}, points: {}, runs: {}, lost: {} };
    for (let at = 0; at <= wanted; at++)
      for (const [room, entries] of Object.entries(data.changes[at]))
        for (const [name, value] of Object.entries(entries))
          if (value === null) delete state[room][name];
          else state[room][name] = value;
    return state;
  }

  function element(tag, options = {}, ...children) {
    const made = Object.assign(document.createElement(tag), options);
    made.append(...children);
    return made;
  }
  const quiet = (text) => element("span", { className: "quiet", textContent: text });
  const line = (...children) => element("span", { className: "line" }, ...children);
  const listed = (names) => (names.length ? names.join(", ") : "–");
  const coloured = (train) => {
    const sign = element("i");
    sign.style.background = data.colours[train] || "#888";
    return element("span", { className: "train" }, sign, train);
  };

  function fill(table, rows, none, span) {
    const body = get(table).tBodies[0];
    body.replaceChildren(
      ...rows.map(([changed, cells]) =>
        element("tr", { className: changed ? "changed" : "" }, ...cells.map((cell) => element("td", {}, ...[cell].flat()))),
      ),
    );
    if (!rows.length) body.append(element("tr", {}, element("td", { className: "none", colSpan: span, textContent: none })));
  }

  function firstLoop(run) {
    if (!run.first.length) return quiet("no route");
    const lamps = run.first.map((lit, at) => element("span", { className: lit ? "lit" : "", textContent: data.loop[at] }));
    return element("span", { className: "lamps" }, ...lamps);
  }

  function secondLoop(run) {
    if (run.second === null) return quiet("not on board");
    if (!run.second.closed) return element("span", { className: "bad", textContent: "open" });
    return [line("closed"), ...(run.second.next ? [line(quiet(`next tag ${run.second.next}`))] : [])];
  }

  function thirdLoop(run) {
    const parts = [];
    if (run.left.length) parts.push(line(quiet("left "), listed(run.left)));
    if (run.reported.length) parts.push(line(quiet("reported "), listed(run.reported)));
    const released = Object.entries(run.released).map(([block, cause]) => `${block} (${cause})`);
    if (released.length) parts.push(line(quiet("released "), listed(released)));
    return parts.length ? parts : quiet("–");
  }

  // Of many runs, those that are over are left out, but for what this step changed.
  function showRuns(runs, changed) {
    const all = Object.entries(runs).sort(([, a], [, b]) => a.serial - b.serial);
    const some = all.length > 10 ? all.filter(([name, run]) => !run.over || name in changed) : all;
    get("left-out").textContent = some.length < all.length ? `${all.length - some.length} runs that are over are left out` : "";
    const rows = some.map(([name, run]) => [
      name in changed,
      [
        [line(`#${run.serial} `, coloured(run.train)), line(quiet(run.route === "standing" ? "stands" : run.route))],
        [line(run.stage), ...run.notes.map((note) => line(quiet(note)))],
        firstLoop(run),
        secondLoop(run),
        thirdLoop(run),
      ],
    ]);
    fill("runs", rows, "no run is known", 5);
  }

  function showTrains(trains, changed) {
    const rows = Object.entries(trains).map(([name, train]) => {
      const cars = Object.entries(train.cars);
      const same = cars.every(([, blocks]) => String(blocks) === String(cars[0][1]));
      const where = same ? [line(listed(cars.length ? cars[0][1] : []))] : cars.map(([car, blocks]) => line(quiet(`${car} `), listed(blocks)));
      const does = [line(train.does), ...(train.parted ? [line(element("span", { className: "bad", textContent: "parted" }))] : [])];
      return [name in changed, [[line(coloured(name)), line(quiet(`life ${train.life}`))], where, listed(train.occupied), does, train.known]];
    });
    fill("trains", rows, "there are no trains", 5);
  }

  function showPoints(points, changed) {
    const rows = Object.entries(points).map(([name, point]) => {
      const holds = point.holds === null ? "holds no run" : `holds #${point.holds}`;
      const wanted = point.wanted === null ? "" : `, wants ${point.wanted}`;
      const lock = point.locked ? line("locked") : line(element("span", { className: "bad", textContent: "unlocked" }));
      const held = point.lost ? quiet("not recovered") : point.for.length ? point.for.map((serial) => `#${serial}`).join(" ") : quiet("–");
      return [name in changed, [name, point.lies, [lock, line(quiet(holds + wanted))], held]];
    });
    fill("points", rows, "there are no points", 4);
  }

  function showCard(item) {
    const kind = item.querySelector("b").textContent;
    const text = (name) => (item.querySelector(name) ? item.querySelector(name).textContent : "");
    const by = text("em");
    get("title").textContent = step === 0 ? "at the start" : `${step} ${kind}${by ? ` (${by})` : ""}`;
    get("meaning").textContent = step === 0 ? "Everything has just started; trains have not told where they stand." : data.meanings[kind];
    get("told").textContent = text(".told");
    get("outcome").textContent = text(".comes-to");
    get("card").classList.toggle("bad", step === data.failure);
  }

  // Scrolls a box by hand, so that what is shown is in its middle: scrollIntoView would move the page as well.
  function reveal(box, low, high, from, size, margin) {
    const room = box[size] - margin;
    if (low - margin < box[from] || high > box[from] + box[size]) box[from] = (low + high) / 2 - margin - room / 2;
  }

  function show(wanted, remember = true) {
    const next = Math.max(0, Math.min(data.last, wanted));
    if (next === step) return;
    if (step >= 0) items[step].classList.remove("now");
    step = next;
    const state = stateAt(step);
    const changed = step === 0 ? {} : data.changes[step];
    showRuns(state.runs, changed.runs || {});
    showTrains(state.trains, changed.trains || {});
    showPoints(state.points, changed.points || {});
    items[step].classList.add("now");
    showCard(items[step]);
    cursor.setAttribute("x", left + column * step);
    get("slider").value = step;
    get("where").textContent = `step ${step} of ${data.last}`;
    get("where").classList.toggle("bad", step === data.failure);
    for (const id of ["to-start", "back"]) get(id).disabled = step === 0;
    for (const id of ["on", "to-end"]) get(id).disabled = step === data.last;
    const rows = data.concerns[step].map((row) => labels[row]);
    for (const label of labels) label.classList.toggle("now", rows.includes(label));
    if (rows.length) {
      const ys = rows.map((label) => Number(label.getAttribute("y")));
      reveal(get("diagram"), Math.min(...ys) - 20, Math.max(...ys) + 14, "scrollTop", "clientHeight", top);
    }
    reveal(get("diagram"), left + column * step, left + column * (step + 1), "scrollLeft", "clientWidth", left);
    reveal(get("steps"), items[step].offsetTop, items[step].offsetTop + items[step].offsetHeight, "scrollTop", "clientHeight", 0);
    if (remember) history.replaceState(null, "", `#step=${step}`);
  }

  const toFailure = () => data.failure !== null && show(data.failure);
  const keys = {
    ArrowLeft: () => show(step - 1),
    ArrowRight: () => show(step + 1),
    Home: () => show(0),
    End: () => show(data.last),
    f: toFailure,
  };
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || !(event.key in keys)) return;
    event.preventDefault();
    keys[event.key]();
  });
  get("to-start").addEventListener("click", keys.Home);
  get("back").addEventListener("click", keys.ArrowLeft);
  get("on").addEventListener("click", keys.ArrowRight);
  get("to-end").addEventListener("click", keys.End);
  get("to-failure").addEventListener("click", toFailure);
  get("slider").addEventListener("input", (event) => show(Number(event.target.value)));
  get("steps").addEventListener("click", (event) => {
    const item = event.target.closest("li");
    if (item) show(Number(item.dataset.step));
  });
  svg.addEventListener("click", (event) => {
    const x = ((event.clientX - svg.getBoundingClientRect().left) * svg.viewBox.baseVal.width) / svg.getBoundingClientRect().width;
    if (x >= left + get("diagram").scrollLeft) show(Math.floor((x - left) / column));
  });
  // The names of the blocks stay at the left, and the numbers of the steps at the top, while the diagram is scrolled.
  get("diagram").addEventListener("scroll", () => {
    const { scrollLeft, scrollTop } = get("diagram");
    get("labels").style.transform = `translateX(${scrollLeft}px)`;
    get("axis").style.transform = `translateY(${scrollTop}px)`;
    get("corner").style.transform = `translate(${scrollLeft}px, ${scrollTop}px)`;
  });
  const asked = () => /^#step=(\d+)$/.exec(location.hash);
  window.addEventListener("hashchange", () => asked() && show(Number(asked()[1]), false));
  show(asked() ? Number(asked()[1]) : data.failure === null ? 0 : data.failure, false);
})();
