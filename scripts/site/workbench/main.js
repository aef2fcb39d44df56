// The workbench's beginning: starts the engine and its page, opens what the address names, and loads the editor once the crowd moves.
import { byId, say } from "../../../core/view/page/dom.js";
import { EngineClient } from "../engine/client.js";
import { findOpened } from "./opened.js";

const LONG = 15000; // ms after which an answer of the engine is late
const LATEST = 6000; // ms after which the editor is loaded though no crowd moves: what is opened may have errors

const told = Object.assign(new EventTarget(), { heard: [] }); // "scene", "status", "reloaded", "said" and "failed" of the engine; what it said before the desk was there
let hasMoved;
const moved = new Promise((resolve) => (hasMoved = resolve));
const engine = new EngineClient(window.engineWorker, (event) => {
    if (event.event === "said" && !window.desk) told.heard.push(event.text);
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

/** Waits for an answer of the engine; if it is late, offers to go on without what makes it busy. */
async function patient(answer) {
    const stop = Object.assign(document.createElement("button"), { type: "button", textContent: "Stop it, and edit", onclick: () => {
        history.replaceState({ stopped: true }, ""); // kept over the reload, also where the browser forbids storage
        location.reload();
    } });
    const late = setTimeout(() => notice("The engine has been busy with this scene for long.", stop), LONG);
    try {
        return await answer;
    } finally {
        clearTimeout(late);
        if (stop.isConnected) byId("notice").hidden = true;
    }
}

async function start() {
    connectPage();
    const stopped = history.state?.stopped; // open nothing
    history.replaceState(null, "");
    const opened = await findOpened(location);
    say(byId("title"), opened.title);
    document.title = `${opened.title} – Jostle`;
    if (opened.fault) notice(opened.fault);
    const begun = stopped ? Promise.resolve({ errors: [], stopped }) : patient(engine.call("open", { files: opened.texts, path: opened.scene, installed: opened.installed }));
    begun.catch((error) => notice(error.message));
    told.addEventListener("failed", ({ detail }) => notice(`The engine stopped: ${detail}`));
    await Promise.race([moved, new Promise((resolve) => setTimeout(resolve, LATEST)), begun.then(({ errors }) => (errors.length || stopped ? null : moved), () => null)]);
    const { Desk } = await import("./desk.js");
    window.desk = new Desk({ engine, opened, told, notice, patient, begun: await begun.catch(() => ({ errors: [], stopped: true })) });
    navigator.serviceWorker?.register("offline.js").catch(() => {}); // it loads all files; without it the site needs its server, as any other
}

addEventListener("hashchange", () => location.reload());
start().catch((error) => notice(error.message));
