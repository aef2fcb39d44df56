// The desk: the texts of a project, what of them runs, and what is done with them: save, undo, restart, check while somebody writes.
import { byId, el, fill, say } from "../../../core/view/page/dom.js";
import { newsLines } from "../../../core/view/page/panels/news.js";
import { Editor } from "../editor/editor.js";
import { placeText, problemText } from "../editor/problems.js";
import { EngineClient } from "../engine/client.js";
import { Draft, MOST_DRAFTS } from "../project/draft.js";
import { renameFile } from "../project/references.js";
import { faultsSaid } from "../project/said.js";
import { FilesBar } from "./files_bar.js";
import { LessonPanel } from "./lesson_panel.js";
import { titleOf } from "./opened.js";
import { Share } from "./share.js";

const PAUSE = 350; // ms without a key before what is written is checked
const MOST = 50; // problems listed
const LINES = 300; // of what is printed

/** Gives texts that run the names that their files were given since: none here. */
const keepNames = (texts) => ({ ...texts });

export class Desk {
    /** `given`: {engine, opened, told, notice, patient, begun}: see main.js and opened.js; `begun`: the answer to the first opening. */
    constructor({ engine, opened, told, notice, patient, begun }) {
        Object.assign(this, { engine, opened, told, notice, patient });
        this.scene = opened.scene;
        this.threads = begun.threads; // of a step
        this.texts = { ...opened.texts }; // as written
        this.live = begun.errors.length || begun.stopped ? null : { ...opened.texts }; // as they run; null: nothing runs
        this.versions = []; // what ran before each save, the latest last, with the names that its files have now
        this.moved = keepNames;
        this.words = { words: [], keys: [], spaces: { other: [], own: [] }, methods: [], scene: {}, behaviours: [] };
        this.checker = this.startChecker();
        this.draft = new Draft(opened.name);
        this.editor = new Editor(byId("editor"), {
            words: () => this.words, texts: () => this.texts, change: (path, text) => this.change(path, text), save: () => this.save(),
        });
        this.files = new FilesBar(this);
        this.share = new Share(this);
        byId("save").onclick = () => this.save();
        byId("undo").onclick = () => this.undo();
        byId("restart").onclick = () => this.restart();
        const saveByKey = (event) => {
            if (event.key !== "s" || !(event.ctrlKey || event.metaKey)) return;
            event.preventDefault();
            this.save();
        };
        for (const each of [window, byId("crowd").contentWindow]) each.addEventListener("keydown", saveByKey); // also with the focus on the crowd
        addEventListener("storage", ({ key }) => key === this.draft.key && notice("This edit is open in another tab, too: what is written last, in either, is what comes back."));
        this.said = [];
        this.faults = []; // errors of functions while the crowd runs
        told.addEventListener("failed", () => {
            this.live = null;
            this.hasFailed = true;
            this.refresh();
        });
        told.addEventListener("status", ({ detail }) => (this.isOver = Boolean(detail.end)));
        for (const text of told.heard.splice(0)) this.hear(text);
        told.addEventListener("said", ({ detail }) => this.hear(detail));
        this.lesson = opened.lessons ? new LessonPanel(this, opened.lessons, opened.lesson) : null;
        this.show(this.lesson?.file() ?? this.files.paths().find((path) => path.endsWith(".lua")) ?? this.scene);
        this.loadWords();
        this.bindDivider();
        if (begun.errors.length) this.tellErrors(begun.errors, "Nothing runs yet");
        if (opened.restored) this.tellRestored();
        this.refresh();
        this.checkSoon(0);
    }

    /** Starts the second worker, which gets the module from the first one: that has compiled it. */
    startChecker() {
        const tell = (text) => this.notice(`Errors are not checked while you write: ${text}`);
        const checker = new EngineClient(new Worker("worker.js", { type: "module", name: "second" }), ({ event, text }) => event === "failed" && tell(text));
        this.engine.call("module").then((module) => checker.call("begin", { module })).catch((error) => tell(error.message));
        return checker;
    }

    async loadWords() {
        const answer = await fetch("data/words.json");
        if (answer.ok) this.words = await answer.json();
        else this.notice("Words are not completed: data/words.json is missing.");
        this.shipped = await this.files.library().catch(() => null); // told where somebody asks for it
    }

    tellRestored() {
        const when = new Date(this.opened.restored).toLocaleString([], { dateStyle: "medium", timeStyle: "short" });
        this.notice(`Your work of ${when} is here again: it was not shared.`, el("button", { type: "button", onclick: () => this.discard() }, "Discard it"));
    }

    discard() {
        this.draft.forget();
        location.reload();
    }

    /** Shows a file in the editor. */
    show(path) {
        this.path = path;
        this.editor.show(path, this.texts[path] ?? "");
        this.files?.draw();
    }

    change(path, text) {
        if (this.texts[path] === text) return;
        this.texts[path] = text;
        this.keep();
        this.refresh();
        this.checkSoon(PAUSE);
    }

    /** Chooses the scene that runs from the next start on: nothing is live until then. */
    chooseScene(path) {
        if (path === this.scene) return;
        this.scene = path;
        this.live = null;
        this.versions = [];
        this.moved = keepNames;
        this.faults = [];
        this.keep();
        this.refresh();
        this.checkSoon(0);
    }

    /** Replaces the text of a file by another one, which the editor can take back. */
    replace(path, text) {
        const isNew = !(path in this.texts);
        if (isNew) this.texts[path] = "";
        if (this.path !== path) this.show(path);
        this.editor.replace(path, text);
        this.change(path, text);
        if (isNew) this.files.draw();
    }

    /** Removes a file from the project. */
    remove(path) {
        const text = this.texts[path], shipped = this.shipped?.[path];
        delete this.texts[path];
        delete this.live?.[path];
        this.show(this.scene);
        this.keep();
        this.refresh();
        this.checkSoon(0);
        const later = shipped === undefined ? "" : " A scene that names it gets the one that comes with the engine then.";
        this.tell(`${path} is removed. What runs keeps it until a restart.${later}`, el("button", { type: "button", onclick: () => this.replace(path, text) }, "Put it back"));
    }

    /** Gives a file another path, and puts it into the texts that name it. */
    rename(path, to) {
        const before = this.texts, rename = (texts) => renameFile(texts, path, to), { moved } = this;
        this.texts = rename(before);
        const changed = Object.keys(before).filter((other) => other !== path && this.texts[other] !== before[other]);
        this.versions = this.versions.map(rename);
        this.moved = (texts) => rename(moved(texts));
        if (this.scene === path) this.scene = to;
        for (const other of changed) this.editor.replace(other, this.texts[other]);
        this.editor.drop(path);
        this.show(to);
        this.keep();
        this.refresh();
        this.checkSoon(0);
        this.tell(`${path} is ${to} now${changed.length ? `, also in ${changed.join(", ")}` : ""}. Restart, so that it counts.`,
            el("button", { type: "button", className: "main", onclick: () => this.restart() }, "Restart"));
    }

    /** Keeps what is written in the browser; says what it cannot keep, or no longer. */
    keep() {
        const { kept, dropped, why } = this.draft.keep(this.texts, this.opened.files, { scene: this.scene, lesson: this.lesson?.number, title: this.opened.title });
        if (dropped.length) this.notice(`The browser keeps ${MOST_DRAFTS} pieces of work: that on ${dropped.join(", ")}, the oldest, is no longer kept.`);
        if (!kept && !this.warned) this.notice(`${why}: download your work before you close the tab.`);
        this.warned ||= !kept;
    }

    /** Paths whose texts are not those that run. */
    changed() {
        return Object.keys(this.texts).filter((path) => this.live?.[path] !== this.texts[path]);
    }

    refresh() {
        const changed = this.changed();
        byId("save").disabled = changed.length === 0;
        byId("undo").disabled = this.versions.length === 0;
        byId("restart").disabled = false;
        byId("restart").classList.toggle("main", Boolean(this.later));
        say(byId("save"), this.live ? "Save" : "Start");
        say(byId("title"), this.lesson ? this.opened.title : titleOf((this.live ?? this.texts)[this.scene], this.scene));
        byId("waiting").hidden = this.live !== null;
        this.files.draw();
    }

    checkSoon(wait) {
        clearTimeout(this.timer);
        this.timer = setTimeout(() => this.check(), wait);
    }

    /** Checks the texts as they are written, and shows what is wrong. */
    async check() {
        const asked = (this.asked = { ...this.texts });
        let problems;
        try {
            problems = await this.checker.call("check", { files: asked, path: this.scene });
        } catch (error) {
            return this.notice(`Errors are not checked while you write: ${error.message}`);
        }
        if (asked === this.asked) this.setProblems(problems);
        return problems;
    }

    /** Shows what is wrong: in the texts, and what went wrong while they ran. */
    setProblems(checked) {
        this.checked = checked;
        const problems = [...this.faults, ...checked];
        this.problems = problems;
        this.editor.setProblems(problems);
        const node = byId("problems"), errors = problems.filter((p) => p.severity === "error").length;
        node.hidden = problems.length === 0;
        fill(node, el("h2", {}, errors === 0 ? "Notes" : errors === 1 ? "1 error" : `${errors} errors`), el("ul", {}, problems.slice(0, MOST).map((p) => el("li", { "data-severity": p.severity },
            el("button", { type: "button", onclick: () => this.goTo(p) }, placeText(p)), ` ${problemText(p)}`))));
        this.files.draw();
    }

    goTo(problem) {
        if (!(problem.file in this.texts)) return this.tellAbsent(problem.file);
        this.show(problem.file);
        if (problem.line) this.editor.goTo(problem);
    }

    /** Tells of a file that is not among the texts, and offers it where it is shipped. */
    tellAbsent(file) {
        const text = this.shipped?.[file];
        this.tell(`${file} is not among these files${text === undefined ? "." : ": it is the one that comes with the engine."}`,
            text === undefined ? [] : el("button", { type: "button", onclick: () => this.replace(file, text) }, "Add it, to change it"));
    }

    /** Saves: loads changed files into the crowd that runs, or begins it. */
    async save() {
        if (this.saving) return;
        const changed = this.changed();
        if (changed.length === 0) return this.tell("Nothing has changed since the last save.");
        this.saving = true;
        try {
            await (this.live ? this.reload(changed) : this.begin("Started"));
        } catch (error) {
            this.tell(`That was not saved: ${error.message}`);
        } finally {
            this.saving = false;
            this.refresh();
        }
        await this.lesson?.check();
    }

    /** Loads files into the crowd that runs; with `back`, as the way back from a save. */
    async reload(changed, back = false) {
        const files = Object.fromEntries(changed.map((path) => [path, this.texts[path]])), before = { ...this.live };
        const { errors, news, taken, unread } = await this.patient(this.engine.call("reload", { files }));
        if (errors.length) return this.tellErrors(errors, "Not live: the version before keeps running");
        this.live = { ...this.live, ...Object.fromEntries([...taken, ...unread].map((path) => [path, files[path]])) };
        this.later ||= news.some((item) => item.later);
        if (!back && taken.length) this.versions.push(this.moved(before));
        this.faults = []; // those that are left come again
        this.setProblems((this.checked ?? []).filter((p) => p.severity !== "error"));
        this.tellNews(news, back, unread);
        this.checkSoon(0);
        this.lastNews = news;
    }

    /** Begins the scene anew with what is written. */
    async begin(done) {
        this.tell("Starting the scene ...");
        const { faults } = this;
        this.faults = [];
        const texts = { ...this.texts }, wasChanged = this.changed().length > 0; // what is written meanwhile is not live
        const { errors } = await this.patient(this.engine.call("open", { files: texts, path: this.scene }));
        if (errors.length) {
            this.faults = faults; // what runs is as before
            return this.tellErrors(errors, this.live ? "Not restarted: the version before keeps running" : "Nothing runs yet");
        }
        if (this.live && wasChanged) this.versions.push(this.moved(this.live));
        this.live = texts;
        this.moved = keepNames;
        this.lastNews = [];
        this.later = false;
        if (this.hasFailed) byId("notice").hidden = true; // which told of that
        this.hasFailed = false;
        this.setProblems(this.checked ?? []);
        this.tell(`${done} with ${Object.keys(texts).length === 1 ? "this file" : `these ${Object.keys(texts).length} files`}.`);
        this.checkSoon(0);
    }

    async restart() {
        try {
            await this.begin("Started anew");
        } catch (error) {
            this.tell(`Not restarted: ${error.message}`);
        }
        this.refresh();
        await this.lesson?.check();
    }

    /** Takes the last save back: texts and machines as before it. */
    async undo() {
        const before = this.versions.pop();
        if (!before) return;
        const changed = Object.keys(before).filter((path) => path in this.texts && before[path] !== this.live?.[path]);
        for (const path of changed) this.replace(path, before[path]);
        try {
            await (this.live ? this.reload(changed, true) : this.begin("Started with the version before"));
        } catch (error) {
            this.tell(`The save was not taken back: ${error.message}`);
        }
        this.refresh();
    }

    /** Shows what the engine and behaviours print, as natively the terminal does; errors of functions also among the problems. */
    hear(text) {
        const known = new Set(this.faults.map((f) => `${f.file}:${f.line}`)), faults = faultsSaid(text).filter((f) => !known.has(`${f.file}:${f.line}`));
        if (faults.length && this.faults.length < MOST) {
            this.faults.push(...faults);
            this.setProblems(this.checked ?? []);
        }
        this.said = [...this.said, ...text.split("\n")].slice(-LINES);
        const node = byId("said"), lines = node.querySelector("pre"), follows = lines.scrollTop + lines.clientHeight >= lines.scrollHeight - 4;
        node.hidden = false;
        lines.textContent = this.said.join("\n");
        if (follows) lines.scrollTop = lines.scrollHeight;
    }

    tell(text, ...more) {
        const node = byId("outcome");
        delete node.dataset.kind;
        node.hidden = false;
        fill(node, el("button", { type: "button", className: "close", "aria-label": "Close", onclick: () => (node.hidden = true) }, "×"), el("p", {}, text), more);
    }

    tellErrors(errors, what) {
        this.setProblems(errors);
        this.tell(`${what}. ${errors.length === 1 ? "1 error" : `${errors.length} errors`}, the first in ${placeText(errors[0])}: ${problemText(errors[0])}`);
        byId("outcome").dataset.kind = "error";
    }

    /** Tells what a save changed: people by state before and after, and what needs a restart. */
    tellNews(news, back, unread) {
        const later = news.some((item) => item.later);
        const rows = news.map((item) => el("div", { className: "item" }, el("strong", {}, `${item.file.split("/").pop()} is ${back ? "as before" : "live"}`), el("ul", {}, newsLines(item).map((line) => el("li", {}, line)))));
        if (unread.length) rows.push(el("p", {}, `Nothing that runs reads ${unread.join(", ")}: a scene or a behaviour has to name it.`));
        this.tell(rows.length ? "" : back ? "The save is taken back." : "Saved.", rows, el("div", { className: "row" },
            later || this.isOver ? el("button", { type: "button", className: "main", onclick: () => this.restart() }, later ? "Restart, so that all of it counts" : "The run is over: restart") : null,
            back || unread.length > news.length ? null : el("button", { type: "button", onclick: () => this.undo() }, "Undo this save")));
    }

    /** Opens another project in place of this one: {scene, files}. */
    async open({ scene, files }, done) {
        const before = { scene: this.scene, files: this.texts };
        this.scene = scene;
        this.texts = { ...files };
        this.live = null;
        this.versions = [];
        this.moved = keepNames;
        this.editor.forget();
        this.show(this.lesson?.file() ?? scene);
        this.keep();
        await this.restart();
        if (this.live && done) this.tell(done);
        this.share.offerBack(before);
        byId("outcome").append(el("button", { type: "button", onclick: () => this.open(before, "What was here before is back.") }, "Back to what was here"));
    }

    bindDivider() {
        const divider = byId("divider"), main = divider.parentElement;
        const set = (share) => {
            const kept = Math.min(75, Math.max(20, share));
            main.style.setProperty("--desk", `${kept.toFixed(1)}%`);
            divider.setAttribute("aria-valuenow", String(Math.round(kept)));
        };
        divider.onpointerdown = (event) => {
            divider.setPointerCapture(event.pointerId);
            document.body.classList.add("dragging"); // the frame would take the pointer
            divider.onpointermove = (move) => set((100 * move.clientX) / innerWidth);
        };
        divider.onpointerup = divider.onpointercancel = () => {
            divider.onpointermove = null;
            document.body.classList.remove("dragging");
        };
        divider.onkeydown = ({ key }) => {
            const by = { ArrowLeft: -3, ArrowRight: 3 }[key];
            if (by) set((100 * divider.getBoundingClientRect().left) / innerWidth + by);
        };
    }
}
