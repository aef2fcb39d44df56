// The card on what a scene shows and what to try: in the first seconds, and whenever it is asked for.
import { byId, el, fill } from "../dom.js";

const SHOWN = 12000; // ms that the card stays by itself

export class AboutCard {
    constructor() {
        this.node = byId("about");
        this.button = null; // in the bar; it tells whether the card is open
        this.node.addEventListener("keydown", (event) => {
            if (event.key === "Escape" && this.close()) event.stopPropagation();
        });
    }

    /** Takes a scene message; the card opens by itself with the first one of a scene that says what it is about. */
    set(scene) {
        const tries = ["Click a person: what it wants and why. Space stops the time, ? lists all keys.",
            scene.tools?.throw ? "Throw a box by the second tool." : null, scene.tools?.push ? "Push somebody by the tool Push." : null,
            scene.tools?.players?.length ? "Drive the player by the tab Act." : null].filter(Boolean);
        const close = el("button", { type: "button", className: "close", "aria-label": "Close what this scene is about", title: "Close (Esc)", onclick: () => this.close() }, "×");
        const told = JSON.stringify([scene.title, scene.about, tries]);
        if (told !== this.told) {
            fill(this.node, el("h2", { id: "about-title" }, scene.title || scene.file || "Jostle"), scene.about ? el("p", {}, scene.about) : null,
                el("p", { className: "faint" }, tries.join(" ")), close);
        }
        this.told = told;
        if (this.file !== scene.file && scene.about && !scene.game) {
            this.show(true);
            this.asked = false;
            this.waits = true;
        }
        this.file = scene.file;
    }

    /** Called after each picture: the time of the card begins with the first one that shows it. */
    seen() {
        if (this.waits) setTimeout(() => this.fade(), SHOWN);
        this.waits = false;
    }

    fade() {
        if (this.asked || this.node.hidden) return;
        if (this.node.matches(":hover, :focus-within")) setTimeout(() => this.fade(), 2000);
        else this.show(false);
    }

    /** Opens the card because the user wants it, or closes it. */
    toggle() {
        this.asked = this.node.hidden;
        this.show(this.asked);
        if (this.asked) this.node.querySelector(".close").focus();
    }

    show(on) {
        const inside = this.node.contains(document.activeElement);
        this.node.hidden = !on;
        this.button?.setAttribute("aria-pressed", String(on));
        if (!on && inside) (this.button?.getClientRects().length ? this.button : byId("picture")).focus();
    }

    /** Closes the card; true if it was asked for: one that came by itself goes with whatever else Escape does. */
    closeAsked() {
        return this.close() && this.asked;
    }

    /** Closes the card; false if it is closed. */
    close() {
        if (this.node.hidden) return false;
        this.show(false);
        return true;
    }
}
