// Touch drives the player: a stick at the lower left, the button at the lower right. They come with the first touch.
import { el } from "../dom.js";

const REACH = 46; // CSS pixels from the middle of the stick to its end

export class Touch {
    /** Puts the controls into `stage`. */
    constructor(stage, player) {
        this.player = player;
        this.knob = el("span", { className: "knob" });
        this.base = el("div", { className: "stick", "aria-hidden": "true" }, this.knob);
        this.fire = el("button", { type: "button", className: "fire", tabIndex: -1 });
        this.node = el("div", { className: "touch", hidden: true }, this.base, this.fire);
        stage.append(this.node);
        this.now = { right: 0, up: 0, button: false };
        this.seen = matchMedia("(pointer: coarse)").matches;
        this.shown = false;
        window.addEventListener("pointerdown", (event) => {
            if (event.pointerType === "touch") this.seen = true;
            this.show(this.shown, this.fire.textContent);
        }, true);
        this.hold(this.base, (event) => this.lean(event), () => this.give({ right: 0, up: 0 }));
        this.hold(this.fire, () => this.give({ button: true }), () => this.give({ button: false }));
    }

    /** Shows the controls while somebody plays; `word`: what the button does, empty for none. */
    show(on, word) {
        this.shown = on;
        this.node.hidden = !on || !this.seen;
        this.fire.textContent = word ?? "";
        this.fire.hidden = !word;
    }

    /** Calls `down` while a finger is on a node, `up` when it leaves. */
    hold(node, down, up) {
        let finger = null;
        node.addEventListener("pointerdown", (event) => {
            event.preventDefault();
            finger = event.pointerId;
            node.setPointerCapture?.(finger);
            down(event);
        });
        node.addEventListener("pointermove", (event) => event.pointerId === finger && down(event));
        for (const name of ["pointerup", "pointercancel"]) {
            node.addEventListener(name, (event) => {
                if (event.pointerId !== finger) return;
                finger = null;
                up();
            });
        }
    }

    lean(event) {
        const box = this.base.getBoundingClientRect();
        const x = (event.clientX - box.left - box.width / 2) / REACH, y = (event.clientY - box.top - box.height / 2) / REACH;
        const far = Math.max(1, Math.hypot(x, y));
        this.give({ right: x / far, up: -y / far });
    }

    give(change) {
        Object.assign(this.now, change);
        const { right, up, button } = this.now;
        this.knob.style.transform = `translate(${REACH * right}px, ${-REACH * up}px)`;
        this.player.stick("touch", right, up, button);
    }
}
