// The walk through the tutorial: a lesson's text, what it asks for, and the way to the next one.
import { byId, el, fill } from "../../../core/view/page/dom.js";
import { lessonFiles } from "./opened.js";
import { CHECKS, ENDS } from "./lesson_checks.js";

const HERE = "You need no terminal here: the list below the editor says what jostle check says, and Save loads the files into the crowd beside it.";

/** Elements of the parts of a line of text (make/lessons.mjs). */
const inline = (parts) => parts.map((p) => (typeof p === "string" ? p : p.code ? el("code", {}, p.code) : p.bold ? el("strong", {}, p.bold) : p.text));

export class LessonPanel {
    /** `lessons`: of data/lessons.json; `number`: from 0. */
    constructor(desk, lessons, number) {
        this.desk = desk;
        this.lessons = lessons;
        this.number = number;
        this.live = { news: [], scene: null, status: null, inspect: null };
        this.node = byId("lesson");
        this.node.hidden = false;
        for (const event of ["scene", "status", "inspect"]) {
            desk.told.addEventListener(event, ({ detail }) => {
                this.live[event] = detail;
                if (this.watches) this.show();
            });
        }
        this.tellAddress();
        this.draw();
        this.check();
    }

    get lesson() {
        return this.lessons[this.number];
    }

    /** The file to show: the one that this lesson writes first, once it is there. */
    file() {
        const first = this.lesson.blocks.find((b) => b.file)?.file;
        return first in this.desk.texts ? first : this.lesson.scene;
    }

    /** Puts the lesson's number into the address; that of a link stays, which opens its files. */
    tellAddress() {
        if (this.desk.opened.name === "lesson") history.replaceState(null, "", `#lesson=${this.number + 1}`);
    }

    /** Goes to a lesson with the files as they are; `afresh` with those that it begins with. */
    async go(number, afresh = false) {
        this.number = number;
        this.asked = {}; // answers about the lesson before come too late
        this.watches = false;
        this.node.dataset.done = "false";
        this.live.news = [];
        this.desk.lastNews = [];
        this.tellAddress();
        this.draw();
        this.node.querySelector(".text").scrollTop = 0;
        if (afresh) await this.desk.open({ scene: this.lesson.scene, files: lessonFiles(this.lesson) });
        const missing = Object.entries(lessonFiles(this.lesson)).filter(([path]) => !(path in this.desk.texts));
        for (const [path, text] of missing) this.desk.replace(path, text);
        this.desk.chooseScene(this.lesson.scene);
        this.desk.show(this.file());
        this.desk.keep();
        await this.check();
    }

    block(block) {
        if (block.text) return el("p", {}, inline(block.text));
        if (block.shell) return el("details", { className: "shell" }, el("summary", {}, "With the program installed"), el("pre", {}, block.shell));
        return el("figure", {}, el("figcaption", {}, el("code", {}, block.file), el("button", { type: "button", onclick: () => this.write(block) }, `Put it into ${block.file}`)), el("pre", {}, block.code));
    }

    write({ file, code }) {
        this.desk.replace(file, code);
        if (/^jostle:/m.test(code)) this.desk.chooseScene(file);
        this.desk.tell(`${file} is written, and not saved yet. ${this.desk.live ? "Save loads it into the crowd" : "Start runs it"} (Ctrl+S).`);
    }

    draw() {
        const { lesson, lessons, number } = this, last = number === lessons.length - 1;
        const choose = el("select", { "aria-label": "Lesson", onchange: () => this.go(Number(choose.value)) },
            lessons.map(({ title }, n) => el("option", { value: n, selected: n === number }, title)));
        this.list = el("ul", { className: "checks" });
        this.done = el("p", { className: "done", role: "status" });
        this.next = el("button", { type: "button", onclick: () => this.go(number + 1) }, "Next lesson");
        fill(this.node, el("div", { className: "row head" }, el("span", { className: "faint" }, `Lesson ${number + 1} of ${lessons.length}`), choose,
            el("button", { type: "button", title: "Begin this lesson with the files of the one before", onclick: () => this.go(number, true) }, "Afresh")),
        el("div", { className: "text", tabIndex: 0 }, el("h2", {}, lesson.title), number === 0 ? el("p", { className: "faint" }, HERE) : null, lesson.blocks.map((b) => this.block(b))),
        el("div", { className: "asks" }, el("h3", {}, "What has to happen"), this.list, el("div", { className: "row" }, this.done, last ? null : this.next)));
    }

    /** Looks at what is written and what runs, after each save. */
    async check() {
        const { desk, lesson } = this, asked = (this.asked = {});
        const tried = new Map();
        let problems;
        try {
            problems = await desk.checker.call("check", { files: desk.live ?? desk.texts, path: lesson.scene });
        } catch {
            return; // told by the desk
        }
        this.live.news = desk.lastNews ?? [];
        const texts = { ...(desk.live ?? desk.texts) };
        const observe = (files, seconds, path) => {
            const key = JSON.stringify([files, seconds, path]);
            if (!tried.has(key)) tried.set(key, desk.checker.call("observe", { files, path, seconds }));
            return tried.get(key);
        };
        const { lessons, live } = this;
        this.look = () => CHECKS[lesson.title]({ texts, problems, observe, live, lessons, scene: lesson.scene });
        this.watches = false;
        const items = await this.look();
        if (asked !== this.asked) return;
        this.showItems(items);
        this.watches = true;
    }

    /** Looks again at the crowd that runs. */
    async show() {
        if (this.looking) return;
        this.looking = true;
        const { asked } = this, items = await this.look().catch(() => null);
        this.looking = false;
        if (items && asked === this.asked) this.showItems(items);
    }

    showItems(items) {
        const line = JSON.stringify(items);
        if (line === this.line && this.list.childElementCount) return;
        this.line = line;
        const all = items.every((i) => i.holds), last = this.number === this.lessons.length - 1;
        this.node.dataset.done = String(all);
        fill(this.list, items.map(({ text, holds, why }) => el("li", { "data-holds": String(holds) }, text, !holds && why ? el("span", { className: "faint" }, ` ${why}`) : null)));
        this.done.textContent = all ? ENDS[this.lesson.title] ?? (last ? "That was the last lesson." : "Done.") : "";
        this.next.classList.toggle("main", all);
    }
}
