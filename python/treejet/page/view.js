// The page around the scene: time, colours, plots. One state, `frame`; everything else follows from it.
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const by_id = id => document.getElementById(id);
  const scene = new Scene(by_id("jet"), data);
  const last = data.time.length - 1, end = data.time[last];
  const [per_second, time_unit] = end < 0.5 ? [1e3, "ms"] : [1, "s"];
  const dash = "\u2013";
  let frame = last, playing = false, shown = -1, ahead = 0, then = 0;

  // --- head and foot
  by_id("name").textContent = data.name;
  const facts = [`${data.time.length} frames to ${short(end * per_second)} ${time_unit}`];
  if (data.thinned.frames > data.time.length) facts.push(`of ${data.thinned.frames} in the file`);
  if (data.thinned.points) facts.push(`points thinned from ${data.thinned.points} a frame`);
  if (data.outcome && data.outcome !== "completed") facts.push(`run ${data.outcome}`);
  by_id("facts").textContent = facts.join(" · ");
  by_id("deck").textContent = data.deck + data.overrides.map(line => `--set "${line}"\n`).join("");
  by_id("program").textContent = data.program;

  // --- colours
  const along = {title: "path from the nozzle", unit: "cm", low: 0, high: Math.max(...data.path), log: false};
  const scalars = [...data.scalars.map(s => ({...s, numbers: numbers(s.data)})), along];
  scalars.forEach((s, k) => by_id("colour").add(new Option(s.title, k)));
  let chosen = scalars[0];

  /** place(i): of point i of a frame on the scale. */
  function parts(frame) {
    const begin = scene.begin[frame];
    if (chosen.numbers) return i => chosen.numbers[begin + i] / 65535;
    const points = scene.points(frame), from_nozzle = [0];
    for (let i = points.length - 1; i > 0; --i)
      from_nozzle.push(from_nozzle[from_nozzle.length - 1] + Math.hypot(...[0, 1, 2].map(k => points[i][k] - points[i - 1][k])));
    from_nozzle.reverse();
    return i => Math.min(1, from_nozzle[i] / along.high);
  }

  function draw_scale() {
    const bar = by_id("bar"), pen = bar.getContext("2d");
    for (let y = 0; y < bar.height; ++y) {
      pen.fillStyle = palette[Math.round(255 * (1 - y / (bar.height - 1)))];
      pen.fillRect(0, y, bar.width, 1);
    }
    const ticks = by_id("ticks"), {low, high, log, unit} = chosen;
    ticks.replaceChildren();
    for (let k = 0; k <= 4; ++k) {
      const value = log ? low * Math.pow(high / low, k / 4) : low + (high - low) * k / 4;
      const mark = document.createElement("span");
      const beyond = (k === 0 && chosen.below) ? "≤ " : (k === 4 && chosen.above) ? "≥ " : "";
      mark.textContent = beyond + short(Number(value.toPrecision(3))) + (k === 4 ? " " + unit : "");
      mark.style.top = `${100 - 25 * k}%`;
      ticks.append(mark);
    }
  }

  // --- plots
  const inks = ["#7fc8bd", "#f0b67f", "#8fa9f0", "#e58ba0", "#c9d37a"];
  const plots = data.panels.map(panel => {
    const figure = document.createElement("figure"), caption = document.createElement("figcaption");
    const canvas = document.createElement("canvas"), title = document.createElement("b");
    title.textContent = panel.title + (panel.unit ? `, ${panel.unit}` : "");
    caption.append(title);
    const readings = panel.lines.map((line, k) => {
      const reading = document.createElement("i");
      reading.style.setProperty("--c", inks[k % inks.length]);
      reading.title = line.meaning;
      caption.append(reading);
      return reading;
    });
    figure.append(caption, canvas);
    by_id("plots").append(figure);
    const go = event => {
      if (event.type === "pointermove" && !event.buttons) return;
      const box = canvas.getBoundingClientRect();
      const part = (event.clientX - box.left - margin.left) / (box.width - margin.left - margin.right);
      stop();
      show(nearest(data.time, Math.min(Math.max(part, 0), 1) * span));
    };
    canvas.addEventListener("pointerdown", go);
    canvas.addEventListener("pointermove", go);
    return {panel, canvas, readings};
  });
  const margin = {left: 46, right: 8, top: 10, bottom: 20};
  const span = Math.max(end, ...data.panels.map(p => p.time[p.time.length - 1]), 1e-30);

  function nearest(times, t) {
    let low = 0, high = times.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      times[middle] <= t ? low = middle : high = middle;
    }
    return t - times[low] <= times[high] - t ? low : high;
  }

  function draw_plot({panel, canvas, readings}) {
    const ratio = window.devicePixelRatio || 1, w = canvas.clientWidth, h = canvas.clientHeight;
    canvas.width = w * ratio;
    canvas.height = h * ratio;
    const pen = canvas.getContext("2d");
    pen.scale(ratio, ratio);
    const values = panel.lines.flatMap(line => line.values).filter(v => v !== null);
    let low = Math.min(...values), high = Math.max(...values);
    if (!values.length) [low, high] = [0, 1];
    if (low > 0 && low < 0.5 * high) low = 0;
    const air = 0.06 * (high - low || Math.abs(high) || 1);
    if (low !== 0) low -= air;
    high += air;
    const x = t => margin.left + t / span * (w - margin.left - margin.right);
    const y = v => h - margin.bottom - (v - low) / (high - low) * (h - margin.top - margin.bottom);
    pen.font = "11px system-ui, sans-serif";
    pen.fillStyle = "#738296";
    pen.strokeStyle = "#222c39";
    pen.lineWidth = 1;
    pen.textAlign = "right";
    const step = round_step((high - low) / 2.2);
    for (let v = Math.ceil(low / step) * step; v <= high; v += step) {
      pen.beginPath();
      pen.moveTo(margin.left, y(v));
      pen.lineTo(w - margin.right, y(v));
      pen.stroke();
      pen.fillText(short(Math.abs(v) < step / 1e6 ? 0 : v), margin.left - 6, y(v) + 4);
    }
    pen.textAlign = "center";
    const tick = round_step(span * per_second / 3);
    for (let t = 0; t <= span * per_second * 1.0001; t += tick) {
      const last_one = t + tick > span * per_second * 1.0001;
      pen.textAlign = last_one && x(t / per_second) > w - 40 ? "right" : "center";
      pen.fillText(short(t) + (last_one ? " " + time_unit : ""), x(t / per_second) + (pen.textAlign === "right" ? 8 : 0), h - 5);
    }
    panel.lines.forEach((line, k) => {
      pen.strokeStyle = inks[k % inks.length];
      pen.lineWidth = 1.6;
      pen.lineJoin = "round";
      pen.beginPath();
      let down = false;
      line.values.forEach((v, i) => {
        if (v === null) return down = false;  // nothing arrived: a gap
        down ? pen.lineTo(x(panel.time[i]), y(v)) : pen.moveTo(x(panel.time[i]) - 0.01, y(v));
        if (!down) pen.lineTo(x(panel.time[i]), y(v));
        down = true;
      });
      pen.stroke();
    });
    const t = data.time[frame], row = nearest(panel.time, t);
    pen.strokeStyle = "#cdd8e455";
    pen.lineWidth = 1;
    pen.beginPath();
    pen.moveTo(x(t), margin.top - 4);
    pen.lineTo(x(t), h - margin.bottom);
    pen.stroke();
    panel.lines.forEach((line, k) => {
      const v = line.values[row];
      readings[k].textContent = `${line.key} ${v === null ? dash : short(v)}`;
      if (v === null) return;
      pen.beginPath();
      pen.arc(x(panel.time[row]), y(v), 3, 0, 2 * Math.PI);
      pen.fillStyle = inks[k % inks.length];
      pen.fill();
    });
  }

  // --- time
  const icon = d => `<svg viewBox="0 0 16 16" aria-hidden="true"><path d="${d}"/></svg>`;
  const slider = by_id("time");
  slider.max = last;

  function show(k) {
    frame = Math.min(Math.max(Math.round(k), 0), last);
    slider.value = frame;
    by_id("clock").textContent = `${(data.time[frame] * per_second).toFixed(Math.max(0, 4 - Math.ceil(Math.log10(span * per_second + 1e-9))))} ${time_unit}`;
    by_id("state").textContent = `${data.beads[frame]} bead${data.beads[frame] === 1 ? "" : "s"} · ${short(Number(data.path[frame].toPrecision(3)))} cm of jet`;
    draw_jet();
    plots.forEach(draw_plot);
    shown = frame;
  }
  function draw_jet() { scene.draw(frame, parts(frame), by_id("beads").checked); }
  function stop() {
    playing = false;
    by_id("play").innerHTML = icon("M4 2l10 6-10 6z");
  }
  function play() {
    if (playing) return stop();
    if (frame === last) show(0);
    playing = true;
    ahead = frame;
    by_id("play").innerHTML = icon("M4 2h3v12H4zM9 2h3v12H9z");
  }
  function tick(now) {
    const passed = Math.min(0.1, (now - then) / 1e3);
    then = now;
    if (playing) {
      // the whole run in 12 seconds, or 30 frames a second
      ahead += passed * Math.min(30, Math.max(last / 12, 8)) * Number(by_id("speed").value);
      if (ahead >= last) stop();
      if (Math.round(ahead) !== shown) show(ahead);
    }
    if (by_id("spin").checked) {
      scene.azimuth += 0.35 * passed;
      draw_jet();
    }
    requestAnimationFrame(tick);
  }

  // --- hands
  const canvas = by_id("jet"), pointers = new Map();
  canvas.addEventListener("pointerdown", event => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, event);
  });
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, event => pointers.delete(event.pointerId));
  canvas.addEventListener("pointermove", event => {
    const before = pointers.get(event.pointerId);
    if (!before) return;
    const dx = event.clientX - before.clientX, dy = event.clientY - before.clientY;
    if (pointers.size === 2) {
      const other = [...pointers].find(([id]) => id !== event.pointerId)[1];
      const apart = e => Math.hypot(e.clientX - other.clientX, e.clientY - other.clientY) || 1;
      scene.zoom = Math.min(Math.max(scene.zoom * apart(event) / apart(before), 0.2), 200);
    } else if (event.shiftKey || event.buttons === 2) {
      scene.shift[0] += dx;
      scene.shift[1] += dy;
    } else {
      scene.azimuth -= dx / 160;
      scene.elevation = Math.min(Math.max(scene.elevation + dy / 160, -Math.PI / 2), Math.PI / 2);
    }
    pointers.set(event.pointerId, event);
    draw_jet();
  });
  canvas.addEventListener("contextmenu", event => event.preventDefault());
  canvas.addEventListener("wheel", event => {
    event.preventDefault();
    const factor = Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0012)), box = canvas.getBoundingClientRect();
    const zoom = Math.min(Math.max(scene.zoom * factor, 0.2), 200), grown = zoom / scene.zoom;
    // what is under the pointer stays there
    const at = [event.clientX - box.left - scene.middle[0], event.clientY - box.top - scene.middle[1]];
    scene.shift = scene.shift.map((s, k) => at[k] - (at[k] - s) * grown);
    scene.zoom = zoom;
    draw_jet();
  }, {passive: false});
  canvas.addEventListener("dblclick", () => { scene.home(); draw_jet(); });
  by_id("play").addEventListener("click", play);
  slider.addEventListener("input", () => { stop(); show(Number(slider.value)); });
  by_id("colour").addEventListener("change", event => { chosen = scalars[event.target.value]; draw_scale(); draw_jet(); });
  by_id("beads").addEventListener("change", draw_jet);
  document.addEventListener("keydown", event => {
    if (/SELECT|INPUT|BUTTON|SUMMARY/.test(event.target.tagName)) return;
    if (event.key === " ") play();
    else if (event.key === "ArrowRight") { stop(); show(frame + (event.shiftKey ? 10 : 1)); }
    else if (event.key === "ArrowLeft") { stop(); show(frame - (event.shiftKey ? 10 : 1)); }
    else return;
    event.preventDefault();
  });
  new ResizeObserver(() => show(frame)).observe(canvas);

  // #frame=K&colour=WORD opens the page there
  const asked = new URLSearchParams(location.hash.slice(1));
  const word = scalars.findIndex(s => s.title === asked.get("colour"));
  if (word >= 0) { chosen = scalars[word]; by_id("colour").value = word; }
  stop();
  draw_scale();
  show(asked.has("frame") ? Number(asked.get("frame")) : last);
  requestAnimationFrame(now => { then = now; tick(now); });
  document.documentElement.dataset.ready = "yes";
})();
