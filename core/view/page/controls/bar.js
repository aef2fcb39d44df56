// The bar over the picture: always one line. Controls that do not fit go into a menu at its end.
import { byId, el, fill, moveFocus } from "../dom.js";
import { icon } from "./icons.js";

/** A button with an icon and a word; if there is little room the bar shows the icon only. */
export function iconButton(name, text, title, onclick, toggles = false) {
    return el("button", { type: "button", className: "iconed", title, onclick, "aria-pressed": toggles ? "false" : null },
        icon(name), el("span", { className: "words" }, text));
}

/** A field whose label has an icon and a word. */
export function iconLabel(name, text, field) {
    return el("label", { className: "iconed", title: text }, icon(name), el("span", { className: "words" }, text), field);
}

export class Bar {
    /** `worded`: the rank below which buttons lose their words, before anything of that rank is folded. */
    constructor(worded) {
        this.worded = worded;
        this.node = byId("bar");
        this.menu = byId("menu");
        this.units = [];
        this.more = el("button", { type: "button", className: "iconed", id: "more", title: "More: controls without room in the bar",
            "aria-expanded": "false", "aria-controls": "menu", onclick: () => this.open(this.menu.hidden, true) }, icon("more"), el("span", { className: "words" }, "More"));
        this.node.append(this.more);
        moveFocus(this.menu, "menu");
        this.menu.addEventListener("keydown", (event) => {
            if (event.key === "Escape" && this.close()) event.stopPropagation();
        });
        document.addEventListener("pointerdown", (event) => {
            if (!this.menu.contains(event.target) && !this.more.contains(event.target)) this.open(false);
        });
        const watch = new ResizeObserver(() => this.fold());
        watch.observe(this.node);
        watch.observe(byId("figures")); // its numbers grow
        document.fonts?.ready.then(() => this.fold());
    }

    /** Adds elements to the group `home` of the bar. Those with the highest `rank` go into the menu first, those without never. */
    add(home, nodes, rank = 0) {
        for (const node of [nodes].flat()) this.units.push({ home, node, rank });
        return nodes;
    }

    /** Opens or closes the menu; `by` a press of its button: its first control gets the focus. */
    open(on, by = false) {
        this.menu.hidden = !on || this.menu.childElementCount === 0;
        if (by && !this.menu.hidden) this.menu.querySelector("button, select, input")?.focus({ preventScroll: true });
        this.more.setAttribute("aria-expanded", String(!this.menu.hidden));
    }

    /** Closes the menu, and takes the focus out of it; false if it was closed already. */
    close() {
        if (this.menu.hidden) return false;
        const inside = this.menu.contains(document.activeElement);
        this.open(false);
        if (inside) this.more.focus();
        return true;
    }

    /** Lays out again: everything in the bar or, in the order of ranks, less and less of it. */
    fold() {
        const focus = document.activeElement;
        const ranks = [Infinity, ...new Set([...this.units.map((u) => u.rank), this.worded])].filter((rank) => rank > 0).sort((a, b) => b - a);
        let most = 0, least = ranks.length - 1; // what fits is found by halves: each try is laid out
        while (most < least) {
            const middle = (most + least) >> 1;
            this.place(ranks[middle]);
            if (this.node.scrollWidth <= this.node.clientWidth) least = middle;
            else most = middle + 1;
        }
        this.place(ranks[least]);
        if (this.menu.childElementCount === 0) this.open(false);
        if (focus !== document.activeElement && focus?.getClientRects().length) focus.focus();
    }

    /** Puts elements of this rank and higher into the menu, the rest into the bar. */
    place(rank) {
        this.node.classList.toggle("worded", rank > this.worded);
        const folded = this.units.filter((u) => u.rank >= rank && !u.node.hidden);
        for (const home of new Set(this.units.map((u) => u.home))) {
            const kept = this.units.filter((u) => u.home === home && !folded.includes(u)).map((u) => u.node);
            if (kept.length !== home.children.length || kept.some((node, i) => node !== home.children[i])) fill(home, kept);
            home.hidden = kept.every((node) => node.hidden);
        }
        const nodes = folded.map((u) => u.node);
        if (nodes.length !== this.menu.children.length || nodes.some((node, i) => node !== this.menu.children[i])) fill(this.menu, nodes);
        this.more.hidden = nodes.length === 0;
    }
}
