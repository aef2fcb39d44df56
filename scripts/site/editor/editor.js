// The editor: one text of several files at a time, with colours, completion, explanations and errors. It is loaded once the crowd moves.
import { autocompletion, closeBrackets, closeBracketsKeymap, completionKeymap } from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap, indentWithTab, isolateHistory } from "@codemirror/commands";
import { yaml } from "@codemirror/lang-yaml";
import { bracketMatching, indentOnInput, indentUnit, StreamLanguage, syntaxHighlighting } from "@codemirror/language";
import { lua } from "@codemirror/legacy-modes/mode/lua";
import { lintGutter, setDiagnostics } from "@codemirror/lint";
import { highlightSelectionMatches, searchKeymap } from "@codemirror/search";
import { EditorState } from "@codemirror/state";
import { drawSelection, EditorView, highlightActiveLine, highlightActiveLineGutter, hoverTooltip, keymap, lineNumbers } from "@codemirror/view";
import { classHighlighter } from "@lezer/highlight";
import { el } from "../../../core/view/page/dom.js";
import { complete, explain } from "./completion.js";
import { placeOf, problemText } from "./problems.js";

const LANGUAGES = { lua: StreamLanguage.define(lua), yaml: yaml() };

/** Parts of a text, those in backquotes as code. */
const withCode = (text) => text.split("`").map((part, n) => (n % 2 ? el("code", {}, part) : part));

function explanation({ name, type, text }) {
    return el("div", { className: "told" }, el("code", {}, type && type.startsWith(name) ? type : type ? `${name}: ${type}` : name), text ? el("p", {}, withCode(text)) : null);
}

export class Editor {
    /**
     * `parent`: the element that holds it. `given`: {words(), texts(), change(path, text), save()}: the words that are known, the texts
     * of all files, and what to do when a text was changed or is to be saved.
     */
    constructor(parent, given) {
        this.given = given;
        this.states = new Map(); // of files that are not shown
        this.problems = [];
        this.path = null;
        this.view = new EditorView({ parent });
    }

    extensions(path) {
        const ending = path.split(".").pop(), { given } = this;
        return [
            lineNumbers(), highlightActiveLine(), highlightActiveLineGutter(), drawSelection(), history(), bracketMatching(), closeBrackets(), indentOnInput(),
            indentUnit.of("  "), EditorState.tabSize.of(2), highlightSelectionMatches(), lintGutter(), syntaxHighlighting(classHighlighter), LANGUAGES[ending] ?? [],
            autocompletion({ override: [(context) => this.completions(path, context)], icons: false }),
            hoverTooltip((view, at) => this.tooltip(path, view.state.doc.toString(), at), { hoverTime: 250 }),
            keymap.of([{ key: "Mod-s", preventDefault: true, run: () => (given.save(), true) },
                ...closeBracketsKeymap, ...completionKeymap, ...searchKeymap, ...historyKeymap, ...defaultKeymap, indentWithTab]),
            EditorView.updateListener.of((update) => update.docChanged && given.change(path, update.state.doc.toString())),
            EditorView.contentAttributes.of({ "aria-label": `Text of ${path}. Tab indents; Escape, then Tab leaves` }),
        ];
    }

    completions(path, context) {
        const text = context.state.doc.toString();
        const found = complete({ path, before: text.slice(0, context.pos), text, words: this.given.words(), files: this.given.texts(), asked: context.explicit });
        if (!found) return null;
        const options = found.options.map((o) => ({ ...o, info: o.info ? () => explanation({ name: o.label, type: o.detail, text: o.info }) : undefined, detail: undefined }));
        return { from: context.pos - found.from, options, validFor: /^\w*$/ };
    }

    tooltip(path, text, at) {
        const found = explain({ path, text, at, words: this.given.words() });
        return found && { pos: found.from, end: found.to, above: true, create: () => ({ dom: explanation(found) }) };
    }

    /** Shows a file; the caret and the history of each are kept. */
    show(path, text) {
        if (this.path === path && this.text() === text) return;
        if (this.path) this.states.set(this.path, this.view.state);
        const kept = this.states.get(path);
        this.path = path;
        this.view.setState(kept && kept.doc.toString() === text ? kept : EditorState.create({ doc: text, extensions: this.extensions(path) }));
        this.mark();
    }

    text() {
        return this.view.state.doc.toString();
    }

    /** Replaces the text of a file, as one change that Ctrl+Z takes back. */
    replace(path, text) {
        if (path !== this.path) {
            const kept = this.states.get(path);
            if (kept) this.states.set(path, kept.update({ changes: { from: 0, to: kept.doc.length, insert: text }, annotations: isolateHistory.of("full") }).state);
        } else if (text !== this.text()) {
            this.view.dispatch({ changes: { from: 0, to: this.view.state.doc.length, insert: text }, annotations: isolateHistory.of("full") });
        }
    }

    /** Forgets the state of a file, which has another name now. */
    drop(path) {
        this.states.delete(path);
        if (this.path === path) this.path = null;
    }

    /** Forgets the states of files: another project is opened. */
    forget() {
        this.states.clear();
        this.path = null;
    }

    /** Underlines problems, of all files, in the one that is shown. */
    setProblems(problems) {
        this.problems = problems;
        this.mark();
    }

    mark() {
        const text = this.text();
        const mine = this.problems.filter((p) => p.file === this.path).map((p) => ({ ...placeOf(text, p), severity: p.severity === "error" ? "error" : p.severity === "warning" ? "warning" : "info", message: problemText(p) }));
        this.view.dispatch(setDiagnostics(this.view.state, mine));
    }

    /** Puts the caret where a problem is. */
    goTo(problem) {
        const { from } = placeOf(this.text(), problem);
        this.view.dispatch({ selection: { anchor: from }, effects: EditorView.scrollIntoView(from, { y: "center" }) });
        this.view.focus();
    }
}
