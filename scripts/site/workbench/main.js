// The workbench's beginning: starts the engine and its page, opens what the address names, and loads the editor once the crowd moves.
import { byId, say } from "../../../core/view/page/dom.js";
import { EngineClient } from "../engine/client.js";
import { findOpened } from "./opened.js";

const LATEST = 6000; // ms after which the editor is loaded though no crowd moves: what is opened may have errors

const told = new EventTarget(); // "scene", "status", "reloaded", "said" and "failed" of the engine
let hasMoved;
const moved = new Promise((resolve) => (hasMoved = resolve));
const engine = new EngineClient(new URL("worker.js", location.href), (event) => {
    told.dispatchEvent(new CustomEvent(event.event, { detail: event.message ?? event.text }));
});

addEventListener("message", ({ origin, data }) => {
    if (origin !== location.origin || data?.jostle !== "moves") return;
    performance.mark("moved");
    hasMoved();
});

function connectPage() {
    if (window.pagePort) engine.call("connect", { port: window.pagePort }, [window.pagePort]);
    window.pagePort = null;
}
window.takePagePort = connectPage;

/** Shows a sentence below the bar until it is closed; `acts`: buttons. */
function notice(text, ...acts) {
    const node = byId("notice"), close = document.createElement("button");
    Object.assign(close, { type: "button", textContent: "×", onclick: () => (node.hidden = true) });
    close.setAttribute("aria-label", "Close");
    node.replaceChildren(Object.assign(document.createElement("span"), { textContent: text }), ...acts, close);
    node.hidden = false;
}

async function start() {
    connectPage();
    const opened = await findOpened(location);
    say(byId("title"), opened.title);
    document.title = `${opened.title} – Jostle`;
    if (opened.fault) notice(opened.fault);
    const begun = engine.call("open", { files: opened.texts, path: opened.scene });
    begun.catch((error) => notice(error.message));
    told.addEventListener("failed", ({ detail }) => notice(`The engine stopped: ${detail}`));
    await Promise.race([moved, new Promise((resolve) => setTimeout(resolve, LATEST)), begun.then(({ errors }) => (errors.length ? null : moved), () => null)]);
    const { Desk } = await import("./desk.js");
    window.desk = new Desk({ engine, opened, told, notice, begun: await begun.catch(() => ({ errors: [] })) });
}

addEventListener("hashchange", () => location.reload());
start().catch((error) => notice(error.message));
