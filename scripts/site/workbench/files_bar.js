// The tabs of files, and what adds one: a new behaviour, a shipped one, or a mod.
import { byId, el, fill } from "../../../core/view/page/dom.js";
import { ENDINGS, folderOf, isFileName, modsNamed, pathsFault, plainPath, turnOnMod } from "../project/references.js";

const BEHAVIOUR = (name) => `return machine {
  name = "${name}", version = 1, start = "Wait",
  states = {
    Wait = { steer = hold },
  },
}
`;

const NAMED = `A file is named like walker.lua or hall.yaml: letters, digits, spaces, "-", "_" and "."; it ends in ${ENDINGS.map((ending) => `.${ending}`).join(", ")}.`;

export class FilesBar {
    constructor(desk) {
        this.desk = desk;
        const menu = byId("add");
        menu.addEventListener("toggle", () => menu.open && this.offer());
        for (const each of document.querySelectorAll("details.menu")) {
            each.addEventListener("keydown", (event) => event.key === "Escape" && (each.open = false));
            document.addEventListener("pointerdown", (event) => !each.contains(event.target) && (each.open = false));
        }
    }

    /** The scene first, then behaviours, modules and mods. */
    paths() {
        const { texts, scene } = this.desk, rank = (path) => (path === scene ? 0 : path.endsWith(".yaml") && !path.includes("/mods/") ? 1 : path.includes("/mods/") ? 4 : path.startsWith("scripts/") ? 3 : 2);
        return Object.keys(texts).sort((a, b) => rank(a) - rank(b) || a.localeCompare(b));
    }

    draw() {
        const { desk } = this, changed = new Set(desk.changed()), wrong = new Set((desk.problems ?? []).filter((p) => p.severity === "error").map((p) => p.file));
        const row = this.paths().map((path) => [path, path === desk.path, changed.has(path), wrong.has(path)]), line = JSON.stringify(row);
        if (line === this.line) return;
        this.line = line;
        fill(byId("tabs"), row.map(([path, shown, isChanged, isWrong]) => el("button", {
            type: "button", role: "tab", "aria-selected": String(shown), title: `${path}${isChanged ? ", changed" : ""}${isWrong ? ", with errors" : ""}`, onclick: () => desk.show(path),
            className: [isChanged ? "changed" : "", isWrong ? "wrong" : ""].join(" "),
        }, path.includes("/mods/") ? path.split("/mods/")[1] : path.split("/").pop())));
    }

    async library() {
        if (!this.shipped) {
            const answer = await fetch("engine/shipped.json");
            if (!answer.ok) throw new Error("The playground lacks engine/shipped.json.");
            this.shipped = await answer.json();
        }
        return this.shipped;
    }

    async offer() {
        const { desk } = this, node = byId("add").querySelector("div"), here = folderOf(desk.scene);
        const name = el("input", { type: "text", placeholder: "name.lua", "aria-label": "Name of a new file", spellcheck: false });
        const form = el("form", { onsubmit: (event) => {
            event.preventDefault();
            this.add(name.value.trim());
        } }, el("label", {}, "New file ", name), el("button", { type: "submit" }, "Add"));
        fill(node, form, el("p", { className: "faint" }, "Loading what is shipped"));
        let files;
        try {
            files = await this.library();
        } catch (error) {
            return fill(node, form, el("p", { className: "faint" }, error.message));
        }
        const lua = Object.keys(files).filter((path) => path.startsWith("behaviours/") && !(path in desk.texts));
        const choose = el("select", { "aria-label": "A shipped behaviour" }, lua.map((path) => el("option", { value: path }, path.split("/").pop())));
        const used = modsNamed(desk.texts[desk.scene]), names = [...new Set(Object.keys(files).map((path) => /^scenes\/mods\/([\w-]+)\//.exec(path)?.[1]).filter(Boolean))];
        const mods = names.filter((mod) => !used.includes(mod) && this.fits(files, mod));
        const shown = desk.path, other = el("input", { type: "text", value: shown, "aria-label": `Another name for ${shown}`, spellcheck: false });
        const rename = el("form", { onsubmit: (event) => {
            event.preventDefault();
            this.rename(shown, other.value.trim());
        } }, other, el("button", { type: "submit" }, "Rename"), shown === desk.scene ? null : el("button", { type: "button", onclick: () => this.remove(shown) }, `Remove ${shown.split("/").pop()}`));
        return fill(node, form, el("div", { className: "row" }, el("label", {}, "Shipped behaviour ", choose), el("button", { type: "button", onclick: () => this.put(choose.value, files[choose.value]) }, "Add")),
            mods.map((mod) => el("div", { className: "row" }, el("button", { type: "button", onclick: () => this.useMod(mod, files, here) }, `Use the mod ${mod}`), el("span", { className: "faint" }, titleOfMod(files, mod)))), el("hr"), el("p", { className: "faint" }, "The file that is shown"), rename);
    }

    /** Whether a mod patches a file of this project. */
    fits(files, mod) {
        const own = new Set(Object.keys(this.desk.texts).map((path) => path.split("/").pop()));
        return Object.keys(files).some((path) => path.startsWith(`scenes/mods/${mod}/patches/`) && own.has(path.split("/").pop()));
    }

    add(name) {
        const { desk } = this, path = plainPath(name.includes("/") ? name : folderOf(desk.scene) + name);
        if (!isFileName(name)) return desk.tell(NAMED);
        if (Object.hasOwn(desk.texts, path)) return desk.show(path);
        const fault = pathsFault([...Object.keys(desk.texts), path]);
        if (fault) return desk.tell(`No file is added: ${fault}.`);
        return this.put(path, name.endsWith(".lua") ? BEHAVIOUR(name.split("/").pop().slice(0, -4)) : name.endsWith(".yaml") ? "jostle: 1\n" : "");
    }

    /** Gives a file another name, in its folder unless that names another one. */
    rename(path, name) {
        const { desk } = this, to = plainPath(name.includes("/") ? name : folderOf(path) + name), ending = (of) => of.split(".").pop();
        byId("add").open = false;
        if (to === path) return undefined;
        if (!isFileName(name)) return desk.tell(NAMED);
        if (ending(to) !== ending(path)) return desk.tell(`${path} is not renamed: its name ends in .${ending(path)}, by which it is read.`);
        if (Object.hasOwn(desk.texts, to)) return desk.tell(`${path} is not renamed: there is a file ${to}.`);
        const fault = pathsFault([...Object.keys(desk.texts).filter((other) => other !== path), to]);
        if (fault) return desk.tell(`${path} is not renamed: ${fault}.`);
        return desk.rename(path, to);
    }

    remove(path) {
        byId("add").open = false;
        this.desk.remove(path);
    }

    put(path, text) {
        byId("add").open = false;
        this.desk.replace(path, text);
    }

    /** Turns a mod on in the scene, and adds its files. */
    useMod(mod, files, here) {
        const { desk } = this;
        for (const [path, text] of Object.entries(files)) if (path.startsWith(`scenes/mods/${mod}/`)) desk.texts[here + path.slice("scenes/".length)] = text;
        this.put(desk.scene, turnOnMod(desk.texts[desk.scene], mod));
        desk.tell(`The scene turns the mod ${mod} on, by its key mods. Restart, so that it counts.`, el("button", { type: "button", className: "main", onclick: () => desk.restart() }, "Restart"));
    }
}

const titleOfMod = (files, mod) => /^title: *(.*)$/m.exec(files[`scenes/mods/${mod}/mod.yaml`] ?? "")?.[1] ?? "";
