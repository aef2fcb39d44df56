// Notes on reloads: which files changed, and how many people were in each state before and after.
import { byId, el, figure, fill } from "../dom.js";

const SHOWN = 15000; // ms that a note stays unless it is pinned, or has the pointer or the focus
const MOST = 3; // notes at once

/** States whose counts changed first, then the others with people: "Walk 120 → 118". Null: nobody is in the machine. */
export function censusText({ before, after }) {
    const was = new Map(before.map((s) => [s.state, s.people])), is = new Map(after.map((s) => [s.state, s.people]));
    const names = [...new Set([...was.keys(), ...is.keys()])];
    const rows = names.map((name) => ({ name, was: was.get(name) ?? 0, is: is.get(name) ?? 0,
        mark: !is.has(name) ? " (gone)" : !was.has(name) ? " (new)" : "" })).filter((r) => r.was || r.is || r.mark);
    if (rows.length === 0) return null;
    const changed = (r) => Number(r.was !== r.is || r.mark !== "");
    return rows.sort((a, b) => changed(b) - changed(a)).map((r) => `${r.name} ${figure(r.was)} → ${figure(r.is)}${r.mark}`).join(", ");
}

/** The lines of a note on one file, from an item of a `reloaded` message. */
export function newsLines(item) {
    if (!item.machine) {
        return [item.done ? `Changed: ${item.done}.` : null, item.later ? `At the next start: ${item.later}.` : null,
            item.done || item.later ? null : "Nothing of it differs."].filter(Boolean);
    }
    const was = new Set(item.before.map((s) => s.state)), is = new Set(item.after.map((s) => s.state));
    const moved = item.before.filter((s) => !is.has(s.state) && s.people > 0);
    return [`People by state: ${censusText(item) ?? "nobody is in this machine"}.`,
        moved.length ? `Moved, because their state is gone: ${moved.map((s) => `${figure(s.people)} from ${s.state}`).join(", ")}.` : null,
        [...is].some((s) => !was.has(s)) && moved.length === 0 ? "Everybody kept their state." : null,
        ...(item.notes ?? "").split("\n").map((line) => line.trim()).filter(Boolean)
            .map((line) => `${line[0].toUpperCase()}${line.slice(1)}.`)].filter(Boolean);
}

/** Whether a list of errors has one that the list before lacked: something was saved that does not go live. */
export function hasNewError(before, errors) {
    const known = new Set(before.map((e) => JSON.stringify(e)));
    return errors.some((e) => !known.has(JSON.stringify(e)));
}

export class News {
    constructor() {
        this.node = byId("news");
        this.errors = [];
    }

    /** Takes the list of an `errors` message: with a new error, notes on what was saved before go. */
    showErrors(errors) {
        if (hasNewError(this.errors, errors)) for (const old of this.node.querySelectorAll(".note:not(.pinned)")) old.remove();
        this.errors = errors;
    }

    /** Takes a `reloaded` message. */
    take({ news }) {
        for (const item of news) this.add(item);
    }

    add(item) {
        const name = item.file.split("/").pop();
        for (const old of this.node.querySelectorAll(`[data-file="${CSS.escape(name)}"]:not(.pinned)`)) old.remove();
        const pin = el("button", { type: "button", "aria-pressed": "false", title: "Keep this note", onclick: () => {
            const on = note.classList.toggle("pinned");
            pin.setAttribute("aria-pressed", String(on));
        } }, "Pin");
        const note = el("section", { className: "note", "data-file": name, title: item.file },
            el("div", { className: "row" }, el("strong", {}, `${name} is live from ${figure(item.time)} s`), pin,
                el("button", { type: "button", "aria-label": `Close the note on ${name}`, onclick: () => note.remove() }, "×")),
            fill(el("ul"), newsLines(item).map((line) => el("li", {}, line))));
        this.node.prepend(note);
        const loose = [...this.node.querySelectorAll(".note:not(.pinned)")];
        for (const old of loose.slice(MOST)) old.remove();
        const fade = () => {
            if (!note.isConnected || note.classList.contains("pinned")) return;
            if (note.matches(":hover, :focus-within")) setTimeout(fade, 2000);
            else note.remove();
        };
        setTimeout(fade, SHOWN);
        pin.addEventListener("click", () => !note.classList.contains("pinned") && setTimeout(fade, SHOWN));
    }
}
