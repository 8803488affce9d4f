"use strict";
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const element = (id) => document.getElementById(id);
  const canvas = element("view");
  const context = canvas.getContext("2d");
  const space = data.dimension === 3;

  // What is shown, and from where: rows of `turn` go to the right, up and towards the eye.
  const identity = () => [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
  const state = { turn: identity(), zoom: 1, shift: [0, 0], hidden: new Set(), leaf: null, time: 0 };

  const points = [];
  for (const item of data.items) {
    for (const line of item.lines) points.push(...line);
    points.push(...item.dots);
  }
  for (const frame of data.frames) points.push(...frame.line);
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (const point of points) for (let i = 0; i < 3; i++) {
    low[i] = Math.min(low[i], point[i]);
    high[i] = Math.max(high[i], point[i]);
  }
  const center = low.map((x, i) => (x + high[i]) / 2);
  const widest = Math.max(0, ...data.items.map((item) => item.radius));
  const size = Math.hypot(...high.map((x, i) => x - low[i])) + 2 * widest || 1;
  const flatSize = [high[0] - low[0] + 2 * widest || 1, high[1] - low[1] + 2 * widest || 1];

  const product = (a, b) => a.map((row) => [0, 1, 2].map((j) => row[0] * b[0][j] + row[1] * b[1][j] + row[2] * b[2][j]));
  const turnAbout = (axis, angle) => {
    const c = Math.cos(angle), s = Math.sin(angle);
    return axis === 0 ? [[1, 0, 0], [0, c, -s], [0, s, c]] : [[c, 0, s], [0, 1, 0], [-s, 0, c]];
  };
  const begin = () => {
    state.turn = space ? product(turnAbout(0, -1.1), product([[0.82, -0.57, 0], [0.57, 0.82, 0], [0, 0, 1]], identity())) : identity();
    state.zoom = 1;
    state.shift = [0, 0];
  };

  let scale = 1;
  const place = (point) => {
    const v = point.map((x, i) => x - center[i]);
    const row = (i) => state.turn[i][0] * v[0] + state.turn[i][1] * v[1] + state.turn[i][2] * v[2];
    return [canvas.width / 2 + state.shift[0] + scale * row(0), canvas.height / 2 + state.shift[1] - scale * row(1)];
  };

  const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim();
  const trace = (line, closed) => {
    context.beginPath();
    line.forEach((point, i) => {
      const [x, y] = place(point);
      if (i === 0) context.moveTo(x, y); else context.lineTo(x, y);
    });
    if (closed) context.closePath();
  };
  const widths = { curve: 2, chord: 2, polygon: 1.6, control: 1, comb: 0.6, inner: 1.2, outer: 1.2, frame: 2 };

  // A piece at a local parameter, by de Casteljau in homogeneous coordinates.
  const pieceAt = (segment, u) => {
    let row = segment.points.map((p, k) => {
      const w = segment.weights.length ? segment.weights[k] : 1;
      return [p[0] * w, p[1] * w, p[2] * w, w];
    });
    while (row.length > 1) row = row.slice(1).map((b, i) => b.map((x, j) => (1 - u) * row[i][j] + u * x));
    return row[0].slice(0, 3).map((x) => x / row[0][3]);
  };
  const range = ([from, to]) => {
    const line = [];
    const first = Math.floor(from), last = Math.ceil(to) - 1;
    for (let i = first; i <= Math.max(first, last) && i < data.segments.length; i++) {
      const a = Math.max(from - i, 0), b = Math.min(to - i, 1);
      for (let j = 0; j <= 12; j++) line.push(pieceAt(data.segments[i], a + ((b - a) * j) / 12));
    }
    return line;
  };

  const draw = () => {
    const ratio = window.devicePixelRatio || 1;
    const [wide, tall] = [canvas.clientWidth * ratio, canvas.clientHeight * ratio];
    if (canvas.width !== Math.round(wide) || canvas.height !== Math.round(tall)) {
      canvas.width = Math.round(wide);
      canvas.height = Math.round(tall);
    }
    const fit = space ? Math.min(wide, tall) / size : Math.min(wide / flatSize[0], tall / flatSize[1]);
    scale = 0.92 * fit * state.zoom;
    context.clearRect(0, 0, canvas.width, canvas.height);
    context.lineJoin = context.lineCap = "round";
    for (const item of data.items) {
      if (state.hidden.has(item)) continue;
      const moved = data.frames.length && state.time > 0 && item.kind === "curve";
      context.strokeStyle = context.fillStyle = colour(item.kind);
      context.globalAlpha = item.kind === "pipe" ? 0.35 : moved ? 0.3 : 1;
      context.lineWidth = item.radius ? Math.max(2 * item.radius * scale, 1) : (widths[item.kind] || 1) * ratio;
      context.setLineDash(item.kind === "control" ? [5 * ratio, 4 * ratio] : []);
      for (const line of item.lines) {
        trace(line, item.closed);
        if (item.filled) {
          context.globalAlpha = 0.2;
          context.fill();
          context.globalAlpha = 1;
        }
        context.stroke();
      }
      for (const point of item.dots) {
        const [x, y] = place(point);
        context.beginPath();
        context.arc(x, y, (item.kind === "mark" ? 4 : 2.6) * ratio, 0, 7);
        context.fill();
      }
    }
    context.globalAlpha = 1;
    context.setLineDash([]);
    if (data.frames.length && state.time > 0) {
      context.strokeStyle = colour("curve");
      context.lineWidth = 2 * ratio;
      trace(data.frames[state.time - 1].line, false);
      context.stroke();
    }
    if (state.leaf !== null) {
      const [a, b] = data.leaves[state.leaf];
      for (const [part, name] of [[a, "leaf-a"], [b, "leaf-b"]]) {
        context.strokeStyle = colour(name);
        context.lineWidth = 6 * ratio;
        context.globalAlpha = 0.8;
        trace(range(part), false);
        context.stroke();
      }
      context.globalAlpha = 1;
    }
  };
  let waiting = false;
  const redraw = () => {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => { waiting = false; draw(); });
  };

  // Mouse and touch: one pointer turns (moves, in the plane), two pointers zoom.
  const pointers = new Map();
  const turn = (x, y) => {
    if (space) state.turn = product(turnAbout(0, y), product(turnAbout(1, x), state.turn));
  };
  canvas.addEventListener("pointerdown", (event) => {
    pointers.set(event.pointerId, [event.clientX, event.clientY]);
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    const before = pointers.get(event.pointerId);
    if (!before) return;
    const now = [event.clientX, event.clientY];
    const ratio = window.devicePixelRatio || 1;
    if (pointers.size === 2) {
      const other = [...pointers].find(([id]) => id !== event.pointerId)[1];
      const distance = (p) => Math.hypot(p[0] - other[0], p[1] - other[1]) || 1;
      state.zoom *= distance(now) / distance(before);
    } else if (space && !event.shiftKey) {
      turn((now[0] - before[0]) / 150, (now[1] - before[1]) / 150);
    } else {
      state.shift = [state.shift[0] + (now[0] - before[0]) * ratio, state.shift[1] + (now[1] - before[1]) * ratio];
    }
    pointers.set(event.pointerId, now);
    redraw();
  });
  for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, (event) => pointers.delete(event.pointerId));
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    state.zoom *= Math.exp(-event.deltaY / 500);
    redraw();
  }, { passive: false });
  canvas.addEventListener("keydown", (event) => {
    const step = 0.1;
    const moves = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step] };
    if (moves[event.key]) {
      const [x, y] = moves[event.key];
      if (space && !event.shiftKey) turn(x, y); else state.shift = [state.shift[0] - 200 * x, state.shift[1] - 200 * y];
    } else if (event.key === "+" || event.key === "=") state.zoom *= 1.15;
    else if (event.key === "-") state.zoom /= 1.15;
    else if (event.key === "0") begin();
    else return;
    event.preventDefault();
    redraw();
  });
  element("hint").textContent = space
    ? "Drag or arrow keys: turn. Wheel, two fingers, + and −: zoom. Shift: move. 0: begin again."
    : "Drag or arrow keys: move. Wheel, two fingers, + and −: zoom. 0: begin again.";

  // The legend switches items on and off.
  for (const item of data.items) {
    const label = document.createElement("label");
    const box = document.createElement("input");
    box.type = "checkbox";
    box.checked = true;
    box.addEventListener("change", () => {
      if (box.checked) state.hidden.delete(item); else state.hidden.add(item);
      redraw();
    });
    const swatch = document.createElement("span");
    swatch.className = "swatch";
    swatch.style.background = "var(--" + item.kind + ")";
    label.append(box, swatch, item.label);
    element("legend").append(label);
  }

  // The motion's slider.
  if (data.frames.length) {
    element("motion").hidden = false;
    const slider = element("time");
    slider.max = data.frames.length;
    slider.addEventListener("input", () => {
      state.time = Number(slider.value);
      element("time-shown").textContent = state.time === 0 ? "0" : String(data.frames[state.time - 1].time);
      redraw();
    });
  }

  // The leaves of the cover tree.
  if (data.leaves.length) {
    element("tree").hidden = false;
    const chooser = element("rule");
    for (const name of ["all", ...data.rules]) chooser.add(new Option(name));
    const list = element("leaves");
    const most = 2000;
    const shown = (x) => String(Math.round(x * 1e6) / 1e6);
    const fill = () => {
      const rule = chooser.value;
      const chosen = data.leaves.map((leaf, i) => [leaf, i]).filter(([leaf]) => rule === "all" || data.rules[leaf[2]] === rule);
      element("leaf-count").textContent = chosen.length + (rule === "all" ? " leaves" : " leaves by " + rule) +
        (chosen.length > most ? ", the first " + most + " are listed" : "");
      list.replaceChildren(...chosen.slice(0, most).map(([leaf, i]) => {
        const line = document.createElement("li");
        line.tabIndex = 0;
        const same = leaf[0][0] === leaf[1][0] && leaf[0][1] === leaf[1][1];
        const part = (p) => "[" + shown(p[0]) + ", " + shown(p[1]) + "]";
        line.textContent = data.rules[leaf[2]] + ": " + part(leaf[0]) + (same ? " with itself" : " and " + part(leaf[1]));
        const choose = () => {
          list.querySelectorAll(".chosen").forEach((other) => other.classList.remove("chosen"));
          line.classList.add("chosen");
          state.leaf = i;
          redraw();
        };
        line.addEventListener("mouseenter", choose);
        line.addEventListener("focus", choose);
        line.addEventListener("click", choose);
        return line;
      }));
    };
    chooser.addEventListener("change", fill);
    element("show-leaves").addEventListener("change", (event) => {
      list.hidden = !event.target.checked;
      if (list.hidden) state.leaf = null;
      redraw();
    });
    fill();
  }

  // The certificate, and the checker.
  if (data.certificate) {
    const bytesOf = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    const certificate = bytesOf(data.certificate);
    const binary = new TextDecoder().decode(certificate.slice(0, 8)) === "KNOTCRT1";
    element("checking").hidden = false;
    const save = element("save");
    save.href = URL.createObjectURL(new Blob([certificate], { type: binary ? "application/octet-stream" : "application/json" }));
    save.download = data.file_name;
    const area = element("certificate");
    const restore = () => { area.value = new TextDecoder().decode(certificate); };
    if (binary) element("edit").hidden = true; else restore();

    const unpacked = (bytes) => new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
    let checker = null;
    const verdict = element("verdict");
    const check = async (bytes) => {
      verdict.className = "";
      verdict.textContent = "checking …";
      try {
        // A checker that stopped half way is not used again.
        checker = checker || (await WebAssembly.instantiate(await unpacked(bytesOf(data.checker)), {})).instance.exports;
        const begun = performance.now();
        // Making room may move the memory: ask for the place first.
        const place = checker.input(bytes.length);
        new Uint8Array(checker.memory.buffer, place, bytes.length).set(bytes);
        const accepted = checker.check();
        const answer = new TextDecoder().decode(new Uint8Array(checker.memory.buffer, checker.answer(), checker.answer_length()));
        const took = Math.max(1, Math.round(performance.now() - begun));
        verdict.className = accepted ? "accepted" : "rejected";
        verdict.textContent = answer + " (" + took + " ms, in this page)";
      } catch (error) {
        checker = null;
        verdict.className = "rejected";
        verdict.textContent = "the checker could not run: " + error;
      }
    };
    element("check").addEventListener("click", () => check(certificate));
    element("check-text").addEventListener("click", () => check(new TextEncoder().encode(area.value)));
    element("restore").addEventListener("click", restore);
    check(certificate);
  }

  begin();
  draw();
  window.addEventListener("resize", redraw);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
})();
