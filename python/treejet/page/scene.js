"use strict";
// The jet in three dimensions on a plain canvas. The axis of the spinning line points down: the world is (y, z, -x), in cm.

const stops = [[122, 108, 232], [74, 152, 226], [47, 182, 168], [142, 214, 107], [248, 228, 110]];

/** Colour of a part of the scale, 0 to 1. */
function colour(part) {
  const at = Math.min(Math.max(part, 0), 1) * (stops.length - 1), k = Math.min(Math.floor(at), stops.length - 2);
  return stops[k].map((low, c) => Math.round(low + (at - k) * (stops[k + 1][c] - low)));
}
const palette = Array.from({length: 256}, (_, k) => `rgb(${colour(k / 255)})`);

/** Numbers from base64 in 16 bits. */
function numbers(text) {
  const bytes = Uint8Array.from(atob(text), c => c.charCodeAt(0));
  return new Uint16Array(bytes.buffer);
}

class Scene {
  constructor(canvas, data) {
    this.canvas = canvas;
    this.pen = canvas.getContext("2d");
    this.data = data;
    this.position = numbers(data.position);
    this.begin = [0];
    for (const n of data.count) this.begin.push(this.begin[this.begin.length - 1] + n);
    const far = Math.max(data.collector ?? 0, data.high[0]);
    const across = Math.max(...[1, 2].flatMap(k => [Math.abs(data.low[k]), Math.abs(data.high[k])]));
    this.top = Math.min(0, data.low[0]);
    this.height = Math.max(far - this.top, 1e-9);
    this.disc = Math.max(1.18 * across, 0.2 * this.height);
    this.home();
  }

  home() {
    this.azimuth = -0.6;
    this.elevation = 0.24;
    this.zoom = 1;
    this.shift = [0, 0];
  }

  /** Points of a frame as (y, z, -x) about the middle of the scene. */
  points(frame) {
    const {low, high} = this.data, found = [];
    for (let i = this.begin[frame]; i < this.begin[frame + 1]; ++i) {
      const r = [0, 1, 2].map(k => low[k] + this.position[3 * i + k] / 65535 * (high[k] - low[k]));
      found.push(this.world(r[0], r[1], r[2]));
    }
    return found;
  }
  world(x, y, z) { return [y, z, this.top + this.height / 2 - x]; }

  /** To the screen: x, y in pixels, scale in pixels a cm, depth. */
  project([a, b, c]) {
    const ca = Math.cos(this.azimuth), sa = Math.sin(this.azimuth), ce = Math.cos(this.elevation), se = Math.sin(this.elevation);
    const right = a * ca + b * sa, into = b * ca - a * sa;
    const up = c * ce + into * se, depth = into * ce - c * se;
    const eye = 3.4 * Math.max(this.height, 2 * this.disc);
    const size = this.unit * this.zoom * eye / Math.max(eye + depth, 0.05 * eye);
    return [this.middle[0] + this.shift[0] + right * size, this.middle[1] + this.shift[1] - up * size, size, depth];
  }

  fit() {
    const ratio = window.devicePixelRatio || 1, {clientWidth: w, clientHeight: h} = this.canvas;
    if (this.canvas.width !== Math.round(w * ratio) || this.canvas.height !== Math.round(h * ratio)) {
      this.canvas.width = Math.round(w * ratio);
      this.canvas.height = Math.round(h * ratio);
    }
    this.pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.middle = [w / 2, h / 2];
    this.unit = Math.min(0.86 * h / (this.height + 0.5 * this.disc), 0.42 * w / this.disc);
    this.pen.clearRect(0, 0, w, h);
  }

  /** part(i): place of point i on the scale of colours. */
  draw(frame, part, beads) {
    this.fit();
    const points = this.points(frame), seen = points.map(p => this.project(p));
    const below = this.elevation < 0;
    if (!below) this.collector(points);
    this.axis();
    const order = [];
    for (let i = 0; i + 1 < points.length; ++i) order.push(i);
    order.sort((i, j) => seen[j][3] + seen[j + 1][3] - seen[i][3] - seen[i + 1][3]);
    const pen = this.pen;
    for (const i of order) {
      const [p, q] = [seen[i], seen[i + 1]], near = (p[2] + q[2]) / (2 * this.unit * this.zoom);
      const width = Math.max(0.9, 2.5 * Math.pow(near, 2) * Math.pow(this.zoom, 0.35));
      this.rim(p, q, width);
      pen.globalAlpha = Math.min(1, Math.max(0.4, 0.95 * Math.pow(near, 3)));
      pen.lineCap = "round";
      pen.strokeStyle = palette[Math.round(255 * (part(i) + part(i + 1)) / 2)];
      pen.lineWidth = width;
      pen.beginPath();
      pen.moveTo(p[0], p[1]);
      pen.lineTo(q[0], q[1]);
      pen.stroke();
      if (beads) this.bead(p, palette[Math.round(255 * part(i))]);
    }
    pen.globalAlpha = 1;
    this.nozzle(points[points.length - 1]);
    if (below) this.collector(points);
  }

  /** Dark sides that keep crossing loops apart; they end before the neighbours begin. */
  rim(p, q, width) {
    const length = Math.hypot(q[0] - p[0], q[1] - p[1]), part = (width + 1) / length, pen = this.pen;
    if (part > 0.35) return;
    const at = s => [p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1])];
    pen.globalAlpha = 0.9;
    pen.lineCap = "butt";
    pen.strokeStyle = "#121922";
    pen.lineWidth = width + 2.6;
    pen.beginPath();
    pen.moveTo(...at(part));
    pen.lineTo(...at(1 - part));
    pen.stroke();
  }

  bead([x, y], fill) {
    this.pen.beginPath();
    this.pen.arc(x, y, 2.6, 0, 2 * Math.PI);
    this.pen.fillStyle = fill;
    this.pen.fill();
  }

  ring(x, radius) {
    this.pen.beginPath();
    for (let k = 0; k <= 72; ++k) {
      const angle = 2 * Math.PI * k / 72, [a, b] = this.project(this.world(x, radius * Math.cos(angle), radius * Math.sin(angle)));
      k ? this.pen.lineTo(a, b) : this.pen.moveTo(a, b);
    }
  }

  /** The plate with rings at round distances, and the jet's shadow on it. */
  collector(points) {
    const x = this.data.collector, pen = this.pen;
    if (x === null) return;
    this.ring(x, this.disc);
    pen.fillStyle = "rgba(150, 175, 200, 0.09)";
    pen.fill();
    pen.strokeStyle = "rgba(160, 185, 210, 0.35)";
    pen.lineWidth = 1;
    pen.stroke();
    const step = round_step(this.disc / 2.2);
    pen.font = "11px system-ui, sans-serif";
    pen.textAlign = "center";
    pen.fillStyle = "rgba(160, 180, 200, 0.6)";
    for (let r = step; r < 0.97 * this.disc; r += step) {
      this.ring(x, r);
      pen.strokeStyle = "rgba(160, 185, 210, 0.13)";
      pen.stroke();
      const [a, b] = this.project(this.world(x, r * Math.sin(this.azimuth), -r * Math.cos(this.azimuth)));
      pen.fillText(short(r) + " cm", a, b + 12);
    }
    pen.beginPath();
    points.forEach((p, i) => {
      const [a, b] = this.project([p[0], p[1], this.world(x, 0, 0)[2]]);
      i ? pen.lineTo(a, b) : pen.moveTo(a, b);
    });
    pen.strokeStyle = "rgba(6, 9, 13, 0.4)";
    pen.lineWidth = 1.6;
    pen.stroke();
  }

  /** The line from the nozzle to the collector; beside the jet a ruler with marks at round distances. */
  axis() {
    const end = this.data.collector ?? this.data.high[0], pen = this.pen, step = round_step(this.height / 4);
    const side = [-this.disc * Math.cos(this.azimuth), -this.disc * Math.sin(this.azimuth)];
    const line = (y, z) => {
      const [p, q] = [this.project(this.world(0, y, z)), this.project(this.world(end, y, z))];
      pen.beginPath();
      pen.moveTo(p[0], p[1]);
      pen.lineTo(q[0], q[1]);
      pen.stroke();
    };
    pen.strokeStyle = "rgba(160, 185, 210, 0.16)";
    pen.lineWidth = 1;
    pen.setLineDash([2, 5]);
    line(0, 0);
    pen.setLineDash([]);
    line(...side);
    pen.font = "11px system-ui, sans-serif";
    pen.textAlign = "right";
    pen.fillStyle = "rgba(160, 180, 200, 0.6)";
    for (let x = 0; x < end + step / 4; x += step) {
      const [a, b] = this.project(this.world(x, ...side));
      pen.fillRect(a - 5, b - 0.5, 5, 1);
      pen.fillText(short(x) + " cm", a - 9, b + 4);
    }
  }

  /** A needle that ends where the jet begins; its width is not to scale. */
  nozzle(end) {
    const [x, y, size] = this.project(end), [tx, ty] = this.project([end[0], end[1], end[2] + 0.085 * this.height]);
    const pen = this.pen, length = Math.hypot(tx - x, ty - y) || 1, w = Math.min(7, Math.max(3.5, 0.03 * this.height * size / 4));
    const n = [-(ty - y) / length, (tx - x) / length], d = [(tx - x) / length, (ty - y) / length];
    pen.beginPath();
    pen.moveTo(x + n[0] * 1.4, y + n[1] * 1.4);
    pen.lineTo(x + d[0] * 12 + n[0] * w, y + d[1] * 12 + n[1] * w);
    pen.lineTo(tx + n[0] * w, ty + n[1] * w);
    pen.lineTo(tx - n[0] * w, ty - n[1] * w);
    pen.lineTo(x + d[0] * 12 - n[0] * w, y + d[1] * 12 - n[1] * w);
    pen.lineTo(x - n[0] * 1.4, y - n[1] * 1.4);
    pen.closePath();
    const shine = pen.createLinearGradient(x + n[0] * w, y + n[1] * w, x - n[0] * w, y - n[1] * w);
    shine.addColorStop(0, "#4d5c6d");
    shine.addColorStop(0.5, "#aebccb");
    shine.addColorStop(1, "#5a6a7c");
    pen.fillStyle = shine;
    pen.fill();
  }
}

/** 1, 2 or 5 times a power of ten, at most `most`. */
function round_step(most) {
  const ten = Math.pow(10, Math.floor(Math.log10(most)));
  return [5, 2, 1].map(k => k * ten).find(s => s <= most * 1.0001);
}

/** A number in four digits at most, without zeros that say nothing. */
function short(v) {
  if (v === 0) return "0";
  const size = Math.abs(v);
  return size >= 1e5 || size < 1e-3 ? v.toExponential(2).replace(/\.?0+e/, "e").replace("e+", "e") : String(Number(v.toPrecision(4)));
}
