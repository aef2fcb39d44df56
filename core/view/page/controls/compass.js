// The compass and the scale bar over the picture.
import { byId, el, say, svg } from "../dom.js";

const WIDEST = 140; // CSS pixels of the scale bar

/** The greatest of 1, 2 and 5 times a power of ten that is at most `most`. */
export function roundDown(most) {
    const unit = 10 ** Math.floor(Math.log10(most)), of = most / unit;
    return unit * (of >= 5 ? 5 : of >= 2 ? 2 : 1);
}

export class Compass {
    constructor(view, redraw) {
        this.view = view;
        this.needle = svg("g", {}, svg("path", { d: "M12 2.5l4 9.5h-8z", fill: "#d55e00", stroke: "none" }), svg("path", { d: "M12 21.5l4-9.5h-8z", fill: "currentColor", stroke: "none", opacity: 0.55 }));
        this.letter = svg("text", { "text-anchor": "middle", "dominant-baseline": "central" }, "N");
        this.button = el("button", { type: "button", id: "compass", title: "North up", onclick: () => {
            this.northUp();
            redraw();
        } }, svg("svg", { viewBox: "-6 -6 36 36", "aria-hidden": "true" }, svg("circle", { cx: 12, cy: 12, r: 17, class: "dial" }), this.needle, this.letter));
        this.length = el("span");
        this.bar = el("div", { id: "scale", title: "Scale in the middle of the picture", role: "img" }, el("i"), this.length);
        byId("stage").append(this.button, this.bar);
        this.shown = "";
    }

    /** rad: by how much the picture is turned: what points right in it, counter-clockwise from the east. */
    turned() {
        const m = this.view.camera.matrixWorld.elements; // its first column points right
        return Math.atan2(m[1], m[0]);
    }

    northUp() {
        if (!this.view.top) this.view.turnBy(-this.turned(), 0, 1);
    }

    /** CSS pixels of a metre across the picture, at its middle; NaN if that is above the horizon. */
    pixelsOfMetre() {
        const { view } = this, floor = view.controls.target.z, at = view.floorAt(view.wide / 2, view.high / 2, floor);
        if (!at) return NaN;
        const turn = this.turned(), across = [Math.cos(turn), Math.sin(turn)];
        const [a, b] = [-0.5, 0.5].map((d) => view.project(at[0] + d * across[0], at[1] + d * across[1], floor));
        return a && b ? Math.hypot(b[0] - a[0], b[1] - a[1]) : NaN;
    }

    /** Called after each picture. */
    update() {
        const degrees = Math.round((this.turned() * 180) / Math.PI), pixels = this.pixelsOfMetre();
        const known = pixels > 0 && Number.isFinite(pixels), metres = known ? roundDown(WIDEST / pixels) : 0;
        const state = `${degrees} ${metres} ${Math.round(metres * pixels)}`;
        if (state === this.shown) return;
        this.shown = state;
        this.needle.setAttribute("transform", `rotate(${degrees} 12 12)`);
        const turn = (degrees * Math.PI) / 180;
        this.letter.setAttribute("x", 12 + 13.5 * Math.sin(turn));
        this.letter.setAttribute("y", 12 - 13.5 * Math.cos(turn));
        this.button.setAttribute("aria-label", degrees === 0 ? "Compass: north is up" : `Compass: north is ${Math.abs(degrees)}° to the ${degrees > 0 ? "right" : "left"}. Turn north up`);
        this.bar.hidden = !known;
        if (!known) return;
        this.bar.firstChild.style.width = `${Math.round(metres * pixels)}px`;
        say(this.length, metres >= 1000 ? `${metres / 1000} km` : metres >= 1 ? `${metres} m` : `${Math.round(metres * 100)} cm`);
        this.bar.setAttribute("aria-label", `Scale in the middle of the picture: ${this.length.textContent}`);
    }
}
