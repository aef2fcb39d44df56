// The socket: reconnects by itself, passes on messages, and counts bytes.

/** What the page says while it loads. */
export const LINK_WORDS = { connecting: "Connecting to the program", connected: "Connected to the program" };
const WAITS = [0.3, 0.6, 1, 2, 4]; // s, between attempts

// The token is kept in this tab only, and removed from the address bar. A page for frames has it in its path, as
// browsers may keep nothing for a frame of another site.
const KEY = "jostle-token";
function token() {
    const inPath = /^\/([0-9a-f]{32})\//.exec(location.pathname);
    if (inPath) return inPath[1];
    const given = new URLSearchParams(location.search).get("token");
    try {
        if (given) {
            sessionStorage.setItem(KEY, given);
            history.replaceState(null, "", location.pathname + location.hash);
        }
        return sessionStorage.getItem(KEY) ?? "";
    } catch {
        return given ?? ""; // this browser keeps nothing: the token stays in the address
    }
}

/**
 * Opens the page's socket. `handlers`: {json(message), binary(buffer), state(text, cause)}, where the
 * state is "connecting", "open" or "lost"; the cause, of findCause, comes a moment later. The token of the page's address is sent with the request.
 */
export class Connection {
    constructor(handlers) {
        this.handlers = handlers;
        this.token = token();
        this.attempt = 0;
        this.bytes = 0; // received since the page was loaded
        this.frames = 0;
        this.unsent = 0; // commands given while there was no connection
        this.open();
    }

    open() {
        const url = new URL("socket", location.href);
        url.protocol = location.protocol === "https:" ? "wss:" : "ws:";
        url.search = new URLSearchParams({ token: this.token });
        url.hash = "";
        this.handlers.state(this.attempt ? "lost" : "connecting");
        const socket = new WebSocket(url, "jostle");
        socket.binaryType = "arraybuffer";
        socket.onopen = () => {
            this.attempt = 0;
            this.handlers.state("open");
        };
        socket.onmessage = (event) => this.receive(event.data);
        socket.onclose = () => this.lost();
        this.socket = socket;
    }

    lost() {
        const wait = WAITS[Math.min(this.attempt, WAITS.length - 1)];
        this.attempt++;
        this.handlers.state("lost");
        this.findCause();
        clearTimeout(this.timer);
        this.timer = setTimeout(() => this.open(), 1000 * wait);
    }

    /** Finds out why there is no connection: "gone", no program answers; "token", it refuses this page; "full", it has no room. */
    async findCause() {
        let cause = "gone";
        try {
            const answer = await fetch(`icon.svg?${new URLSearchParams({ token: this.token })}`, { cache: "no-store" });
            cause = answer.ok ? "full" : "token";
        } catch {
            cause = "gone";
        }
        if (this.socket.readyState !== WebSocket.OPEN) this.handlers.state("lost", cause);
    }

    receive(data) {
        if (typeof data !== "string") {
            this.bytes += data.byteLength;
            this.frames++;
            this.handlers.binary(data);
            return;
        }
        this.bytes += data.length;
        let message;
        try {
            message = JSON.parse(data);
        } catch (error) {
            console.warn(`a message that is no JSON: ${error.message}`);
            return;
        }
        this.handlers.json(message);
    }

    /** Sends one command, an object with the key `do`. False while there is no connection. */
    send(command) {
        if (this.socket.readyState !== WebSocket.OPEN) {
            this.unsent++;
            return false;
        }
        this.socket.send(JSON.stringify(command));
        return true;
    }

    /** One line of the input log, without its tick. Numbers are rounded to what a log needs. */
    input(...words) {
        const line = words.map((w) => (typeof w === "number" ? String(Number(w.toFixed(4))) : w)).join(" ");
        return this.send({ do: "input", line });
    }
}
