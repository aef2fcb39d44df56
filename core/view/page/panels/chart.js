// A chart over time on a canvas: axes with units, lines, and names that say which is which.
import { el, figure, fill } from "../dom.js";

const LEFT = 52, RIGHT = 10, TOP = 22, BOTTOM = 26; // CSS pixels

/** Round numbers for an axis from `low` to `high`, about `count` of them. */
export function ticks(low, high, count) {
    const span = high - low;
    if (!(span > 0)) return [low];
    const raw = span / count, unit = 10 ** Math.floor(Math.log10(raw));
    const step = unit * (raw / unit > 5 ? 10 : raw / unit > 2 ? 5 : raw / unit > 1 ? 2 : 1);
    const out = [];
    for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * span; i++) out.push(i * step);
    return out;
}

export class Chart {
    /** `what`: {title, unit}; series are set by draw. */
    constructor({ title, unit }) {
        this.unit = unit;
        this.canvas = el("canvas", { className: "chart", role: "img" });
        this.canvas.setAttribute("aria-label", `${title}, ${unit}, over time`);
        this.names = el("ul", { className: "key" });
        this.node = el("section", {}, el("h2", {}, title), this.canvas, this.names);
        this.named = "";
    }

    /** `times` in s; `series`: [{name, values, colour}]. */
    draw(times, series) {
        this.legend(series);
        const ratio = Math.min(2, window.devicePixelRatio || 1), box = this.canvas.getBoundingClientRect();
        if (box.width < 10) return;
        const wide = box.width, high = box.height;
        this.canvas.width = Math.round(wide * ratio);
        this.canvas.height = Math.round(high * ratio);
        const pen = this.canvas.getContext("2d");
        pen.scale(ratio, ratio);
        const style = getComputedStyle(this.canvas);
        pen.font = `${0.75 * parseFloat(getComputedStyle(document.documentElement).fontSize)}px system-ui, sans-serif`;
        const colours = { line: style.getPropertyValue("--line"), faint: style.getPropertyValue("--faint"), text: style.getPropertyValue("--text") };
        const t0 = times[0] ?? 0, t1 = Math.max(times[times.length - 1] ?? 1, t0 + 1);
        const most = series.reduce((m, s) => s.values.reduce((a, v) => (v > a ? v : a), m), 0) || 1;
        const steps = ticks(0, most * 1.05, 4), top = Math.max(most * 1.05, steps[steps.length - 1]);
        const x = (t) => LEFT + ((t - t0) / (t1 - t0)) * (wide - LEFT - RIGHT);
        const y = (v) => high - BOTTOM - (v / top) * (high - TOP - BOTTOM);
        this.axes(pen, { t0, t1, steps, x, y, wide, high, colours });
        for (const { values, colour } of series) {
            pen.strokeStyle = colour;
            pen.lineWidth = 1.75;
            pen.lineJoin = "round";
            pen.beginPath();
            let down = false;
            values.forEach((v, i) => {
                if (!Number.isFinite(v)) down = false;
                else if (down) pen.lineTo(x(times[i]), y(v));
                else {
                    pen.moveTo(x(times[i]), y(v));
                    down = true;
                }
            });
            pen.stroke();
        }
    }

    axes(pen, { t0, t1, steps, x, y, wide, high, colours }) {
        pen.fillStyle = colours.faint;
        pen.strokeStyle = colours.line;
        pen.lineWidth = 1;
        pen.textAlign = "right";
        pen.textBaseline = "middle";
        for (const v of steps) {
            pen.beginPath();
            pen.moveTo(LEFT, y(v));
            pen.lineTo(wide - RIGHT, y(v));
            pen.stroke();
            pen.fillText(figure(Number(v.toPrecision(6))), LEFT - 6, y(v));
        }
        pen.textBaseline = "top";
        pen.textAlign = "center";
        const marks = ticks(t0, t1, Math.max(2, Math.floor(wide / 80)));
        marks.forEach((t) => {
            if (x(t) < wide - 40) pen.fillText(figure(Number(t.toPrecision(6))), x(t), high - BOTTOM + 6);
        });
        pen.textAlign = "right";
        pen.fillText("s", wide - RIGHT, high - BOTTOM + 6);
        pen.textAlign = "left";
        pen.textBaseline = "top";
        pen.fillText(this.unit, 4, 2);
    }

    legend(series) {
        const named = series.map((s) => s.name + s.colour).join();
        if (named === this.named) return;
        this.named = named;
        fill(this.names, series.length < 2 && !series[0]?.name ? [] : series.map((s) => {
            const swatch = el("span", { className: "swatch" });
            swatch.style.background = s.colour;
            return el("li", {}, swatch, s.name);
        }));
    }
}
