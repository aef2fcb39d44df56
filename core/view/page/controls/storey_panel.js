// The storeys of a building, over the picture: how they are shown, and which one is looked at.
import { byId, el, fill } from "../dom.js";
import { VIEWS } from "../draw/storeys.js";

export class StoreyPanel {
    /** `page`: {view, crowd, shown()}; `shown` is called when storeys are shown in another way. */
    constructor(page) {
        this.page = page;
        this.select = el("select", { title: "How storeys are shown (S)", "aria-label": "How storeys are shown", onchange: () => this.show({ view: this.select.value }) },
            Object.entries(VIEWS).map(([value, name]) => el("option", { value }, name)));
        this.list = el("div", { className: "list", role: "group", "aria-label": "Storey that is looked at" });
        this.node = el("div", { id: "storeys", hidden: true }, this.select, this.list);
        byId("stage").append(this.node);
    }

    set() {
        const { storeys } = this.page.view;
        this.node.hidden = !storeys.several;
        if (!storeys.several) return;
        this.buttons = storeys.list.map(({ name, height }, k) => el("button", { type: "button", title: `${name}, at ${Number(height.toFixed(2))} m (Page Up, Page Down)`, onclick: () => this.show({ chosen: k }) }, name));
        fill(this.list, [...this.buttons].reverse());
        this.mark();
    }

    /** Shows storeys in another way: {view, chosen}. */
    show(changes) {
        this.page.view.showStoreys(changes);
        this.mark();
        this.page.shown();
    }

    /** Shows the storey of the person in a slot, once they are on another. */
    follow(slot) {
        const { storeys } = this.page.view, deck = this.page.crowd.deck(slot);
        if (!storeys.several) return;
        const { lower, upper } = storeys.decks[deck];
        if (storeys.chosen < lower || storeys.chosen > upper) this.show({ chosen: storeys.isStorey(deck) ? deck : lower });
    }

    /** Marks what is shown. */
    mark() {
        const { storeys } = this.page.view;
        this.select.value = storeys.view;
        this.buttons?.forEach((button, k) => {
            button.setAttribute("aria-pressed", String(k === storeys.chosen));
            button.classList.toggle("unshown", !storeys.isShown(k));
        });
        if (storeys.several) this.buttons[storeys.chosen].scrollIntoView?.({ block: "nearest" });
    }

    /** The next way to show storeys; undefined where there are none. */
    next() {
        const names = Object.keys(VIEWS), { storeys } = this.page.view;
        if (!storeys.several) return undefined;
        this.show({ view: names[(names.indexOf(storeys.view) + 1) % names.length] });
        return true;
    }

    /** Looks at the storey so many above the present one. */
    step(by) {
        const { storeys } = this.page.view, chosen = Math.min(storeys.count - 1, Math.max(0, storeys.chosen + by));
        if (!storeys.several) return undefined;
        if (chosen !== storeys.chosen) this.show({ chosen });
        return true;
    }
}
