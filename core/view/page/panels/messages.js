// Messages of the server: short ones disappear, errors of a reload stay until they are corrected.
import { byId, el, fill } from "../dom.js";

const MOST = 8; // errors listed
const SHOWN = { info: 4000, warning: 7000, error: 10000 }; // ms

export class Messages {
    constructor() {
        this.node = byId("messages");
        this.errors = byId("errors");
        this.standing = new Map();
    }

    /** Shows a line for a few seconds. The same line again only lasts longer. */
    say(text, level = "info") {
        let line = [...this.node.children].find((p) => p.textContent === text);
        if (!line) {
            line = el("p", { className: level }, text);
            this.node.append(line);
            while (this.node.children.length > 5) this.node.firstChild.remove();
        }
        clearTimeout(line.timer);
        line.timer = setTimeout(() => line.remove(), SHOWN[level] ?? 5000);
    }

    /** Shows a line that stays until an empty text replaces it. */
    stand(key, text) {
        if ((this.standing.get(key)?.textContent ?? "") === text) return;
        this.standing.get(key)?.remove();
        this.standing.delete(key);
        if (!text) return;
        const line = el("p", { className: "warning" }, text);
        this.standing.set(key, line);
        this.node.prepend(line);
    }

    /** Shows errors of saved files; an empty list hides them. */
    showErrors(errors) {
        this.errors.hidden = errors.length === 0;
        if (errors.length === 0) return fill(this.errors);
        const plural = errors.length === 1 ? "An error" : `${errors.length} errors`;
        return fill(this.errors, el("h2", {}, `${plural} in what was saved. The version before keeps running.`),
            el("ol", {}, errors.slice(0, MOST).map(errorItem)),
            errors.length > MOST ? el("p", {}, `And ${errors.length - MOST} more, which the terminal lists.`) : null);
    }
}

function errorItem({ file, line, column, text, source, hint }) {
    const place = [file, line || null, line ? column || null : null].filter((part) => part !== null && part !== undefined).join(":");
    const number = String(line ?? "");
    const mark = source && column ? `\n${" ".repeat(number.length + 3)}${source.slice(0, column - 1).replace(/[^\t]/g, " ")}^` : "";
    return el("li", {}, el("strong", {}, place), ` ${text ?? ""} ${hint ?? ""}`,
        source ? el("code", { className: "code" }, `${number} | ${source}${mark}`) : null);
}
