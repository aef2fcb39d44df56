// The tabs of the panel, after the pattern of WAI-ARIA: one stop of the Tab key, arrows between them.
import { byId, el, fill } from "../dom.js";

const NAMES = { scene: "Scene", agent: "Person", machine: "Machine", parameters: "Parameters", charts: "Charts", act: "Act", engine: "Engine" };

export class Panel {
    /** `shown(name)` is called when a tab comes to the front. */
    constructor(shown) {
        this.shown = shown;
        this.pages = {};
        this.tabs = {};
        for (const [name, text] of Object.entries(NAMES)) {
            const tab = el("button", { type: "button", role: "tab", id: `tab-${name}`, "aria-controls": `page-${name}`, "data-name": text,
                onclick: () => this.show(name), onkeydown: (event) => this.key(event, name) }, text);
            const page = el("div", { className: "page", id: `page-${name}`, role: "tabpanel", tabIndex: 0, "aria-labelledby": `tab-${name}`, hidden: true });
            this.tabs[name] = tab;
            this.pages[name] = page;
        }
        fill(byId("tabs"), Object.values(this.tabs));
        const widen = el("button", { type: "button", id: "widen", title: "Wider or narrower panel", "aria-label": "Wider panel", "aria-pressed": "false", onclick: () => {
            const on = document.body.classList.toggle("wide-panel");
            widen.setAttribute("aria-pressed", String(on));
            window.dispatchEvent(new Event("resize"));
        } }, "↔");
        byId("tabs").after(widen);
        fill(byId("pages"), Object.values(this.pages));
        this.show("scene");
    }

    /** Hides a tab that the scene has no use for. */
    offer(name, on) {
        this.tabs[name].hidden = !on;
        if (!on && this.front === name) this.show("scene");
    }

    /** Disables a tab whose page is empty; it keeps its place, or the others would jump. */
    enable(name, on, hint) {
        this.tabs[name].disabled = !on;
        this.tabs[name].title = on ? "" : hint;
        if (!on && this.front === name) this.show("scene");
    }

    show(name) {
        this.front = name;
        for (const [key, tab] of Object.entries(this.tabs)) {
            tab.setAttribute("aria-selected", String(key === name));
            tab.tabIndex = key === name ? 0 : -1;
            this.pages[key].hidden = key !== name;
        }
        this.shown?.(name);
    }

    key(event, name) {
        const names = Object.keys(NAMES).filter((n) => !this.tabs[n].hidden && !this.tabs[n].disabled), at = names.indexOf(name);
        const next = { ArrowRight: at + 1, ArrowLeft: at - 1, Home: 0, End: names.length - 1 }[event.key];
        if (next === undefined) return;
        event.preventDefault();
        const to = names[(next + names.length) % names.length];
        this.show(to);
        this.tabs[to].focus();
    }
}
