// The game of a scene: its start card, score and clock, and the cards at the end of a round and of a match. The engine
// decides; this shows what its statuses say.
import { byId, clock, el, fill, say } from "../dom.js";

const KEYS = "W A S D or arrow keys";

export class GamePanel {
    /** `page`: {send(command), play(on)}: `play` gives the player to the person, or takes them away. */
    constructor(page) {
        this.page = page;
        this.score = byId("score");
        this.card = byId("game");
        this.told = byId("game-told");
        this.rules = null;
        this.state = null;
        this.shown = ""; // which card
        this.playing = false;
        this.pausing = false; // a pause was sent, and no status tells of it yet
        this.card.addEventListener("keydown", (event) => event.key !== "Escape" && event.key !== "Tab" && event.stopPropagation());
    }

    set(scene) {
        const rules = scene.session === "replay" ? null : scene.game ?? null;
        this.title = scene.title;
        if (!rules) return this.close();
        if (!this.rules || this.file !== scene.file) this.level = rules.level;
        this.rules = rules;
        this.file = scene.file;
        this.score.hidden = false;
        if (!this.state?.on && this.shown !== "start") this.showStart();
        return undefined;
    }

    close() {
        this.rules = this.state = null;
        this.score.hidden = true;
        this.show("");
        this.play(false);
    }

    /** Takes a status. */
    take(status) {
        const { rules } = this, state = status.game;
        if (!rules || !state) return;
        const before = this.state, begins = state.on && !state.winner && (!before?.on || before.winner || before.round !== state.round || status.time < this.time);
        this.state = state;
        this.time = status.time;
        this.pausing &&= !status.paused;
        this.showScore(status.time);
        if (this.shown && this.unfocused) this.focus();
        if (begins || (state.on && !state.winner && this.shown === "start" && this.waits)) {
            this.waits = false;
            this.show("");
            this.play(true);
        } else if (state.on && state.winner && this.shown !== "over" && before) this.showOver();
        else if (!state.on && before?.on) this.showStart();
        else if (state.on && !state.winner && this.shown === "pause" && !status.paused && !this.pausing) this.goOn();
        if (!this.shown && before?.on && (before.ours !== state.ours || before.theirs !== state.theirs)) {
            say(this.told, `${rules.ours} ${state.ours}, ${rules.theirs} ${state.theirs}`);
        }
    }

    play(on) {
        if (on === this.playing && !on) return;
        this.playing = on;
        this.page.play(on);
    }

    showScore(time) {
        const { rules, state } = this, left = Math.max(0, rules.time - time);
        const side = (name, score, mine) => el("span", { className: mine ? "side mine" : "side" }, el("span", { className: "name" }, name), el("b", {}, String(score)));
        const rounds = rules.rounds > 1 && state.on ? `Round ${state.round} of ${rules.rounds}, ${state.won[0]} : ${state.won[1]}` : "";
        const line = JSON.stringify([state.ours, state.theirs, Math.ceil(10 * left), rounds]);
        if (line === this.line) return;
        this.line = line;
        const ended = state.winner ? Math.max(0, rules.time - state.ended) : left;
        fill(this.score, side(rules.ours, state.ours, true), el("span", { className: "clock" }, rules.time ? clock(ended) : clock(time)),
            side(rules.theirs, state.theirs, false), el("span", { className: "rounds" }, state.on ? rounds : "the machine plays"));
    }

    levels() {
        const { rules } = this;
        if (rules.levels.length < 2) return null;
        const buttons = rules.levels.map((name) => el("button", { type: "button", "aria-pressed": String(name === this.level), onclick: () => {
            this.level = name;
            for (const b of buttons) b.setAttribute("aria-pressed", String(b.textContent === name));
        } }, name));
        return el("div", { className: "row", role: "group", "aria-label": "Level" }, el("span", { className: "faint" }, "Level"), buttons);
    }

    keys() {
        const { button } = this.rules;
        return el("p", { className: "faint" }, `${KEYS}${button ? `, Space: ${button}` : ""}. A gamepad and touch work, too. Escape pauses.`);
    }

    showStart() {
        const { rules } = this;
        const ends = [rules.points ? `first to ${rules.points}` : null, rules.time ? `${rules.time} s` : null, rules.rounds > 1 ? `best of ${rules.rounds} rounds` : null];
        this.play(false);
        this.show("start", this.title, [el("p", {}, rules.how ?? ""), el("p", {}, `You are ${rules.ours}. ${ends.filter(Boolean).join(", ")}.`.replace(/\. (\w)/, (_, c) => `. ${c.toUpperCase()}`)),
            this.levels(), el("div", { className: "row" }, this.main("Play", () => this.begin(this.level))), this.keys()]);
    }

    showOver() {
        const { rules, state } = this, [ours, theirs] = state.won, name = { ours: rules.ours, theirs: rules.theirs };
        const who = (side) => (side === "draw" ? "A draw" : `${name[side]} wins`);
        this.play(false);
        const score = el("p", { className: "large" }, `${rules.ours} ${state.ours} : ${state.theirs} ${rules.theirs}`);
        if (state.match_over && rules.rounds > 1) {
            const side = ours > theirs ? "ours" : ours < theirs ? "theirs" : "draw";
            this.show("over", side === "ours" ? "You have won the match" : side === "theirs" ? "You have lost the match" : "The match is a draw", [
                el("p", { className: "large" }, `${ours} : ${theirs} rounds`), el("p", { className: "faint" }, `The last round: ${who(state.winner)}, ${state.ours} : ${state.theirs}.`),
                this.levels(), el("div", { className: "row" }, this.main("Again", () => this.begin(this.level)))], side);
        } else if (state.match_over) {
            this.show("over", state.winner === "ours" ? "You have won" : state.winner === "theirs" ? "You have lost" : "A draw",
                [score, this.levels(), el("div", { className: "row" }, this.main("Again", () => this.begin(this.level)))], state.winner);
        } else {
            this.show("over", state.winner === "ours" ? `Round ${state.round} is yours` : state.winner === "theirs" ? `Round ${state.round} is lost` : `Round ${state.round}: a draw`,
                [score, el("p", {}, `Rounds: ${ours} : ${theirs}`), el("div", { className: "row" }, this.main("Next round", () => this.begin()))], state.winner);
        }
    }

    /** Pauses the round; true if there is one. */
    pause() {
        if (!this.playing) return false;
        this.play(false);
        this.page.send({ do: "pause", on: true });
        this.pausing = true;
        this.show("pause", "Paused", [el("div", { className: "row" }, this.main("Go on", () => {
            this.page.send({ do: "pause", on: false });
            this.goOn();
        }), el("button", { type: "button", onclick: () => this.begin(this.level) }, "New match")), this.keys()]);
        return true;
    }

    goOn() {
        this.pausing = false;
        this.show("");
        this.play(true);
    }

    /** Begins a new match at a level, or the next round. */
    begin(level) {
        this.waits = true;
        this.page.send(level ? { do: "play", level } : { do: "play", ...(this.state?.on && this.state.winner ? {} : { level: this.level }) });
    }

    /** Presses the main button of the card that is shown. */
    press() {
        if (this.shown) this.card.querySelector("button.main")?.click();
    }

    main(text, onclick) {
        return el("button", { type: "button", className: "main large", onclick }, text);
    }

    show(which, title = "", content = [], side = "") {
        this.shown = which;
        this.card.hidden = !which;
        if (!which) return;
        this.card.dataset.side = side;
        fill(this.card, el("h2", { id: "game-title" }, title), content);
        say(this.told, title);
        this.unfocused = true;
        this.focus();
    }

    /** Gives the main button the focus, once it can have it: the first card comes before the picture. */
    focus() {
        const button = this.card.querySelector("button.main");
        if (document.activeElement === document.body || this.card.contains(document.activeElement) || document.activeElement?.id === "picture") button.focus({ preventScroll: true });
        this.unfocused = document.activeElement === document.body;
    }
}
