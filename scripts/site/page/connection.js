// The live page's connection in the playground: the build puts it in the place of core/view/page/net/connection.js. Messages come
// by a port from the engine's worker, which gets an answer to each batch and sends the next one then: a slow page gets the newest only.
import { Connection as Socket } from "../../../core/view/page/net/connection.js";

const FRAME = 1; // the first number of a message that is a frame (core/live/README.md)

export const LINK_WORDS = { connecting: "Loading the engine", connected: "The engine is loaded" };

export class Connection extends Socket {
    open() {
        this.isOpen = this.isSeen = false;
        this.shown = 0; // frames taken
        this.handlers.state("connecting");
        const { port1, port2 } = new MessageChannel();
        this.port = port1;
        port1.onmessage = ({ data }) => this.takeBatch(data);
        window.parent.postMessage({ jostle: "connect" }, location.origin, [port2]);
    }

    /** Takes {open} once a scene runs, or {messages}: texts and buffers. The second frame is answered once the first picture is drawn. */
    takeBatch({ open, messages }) {
        if (open) {
            this.isOpen = true;
            this.handlers.state("open");
        }
        if (!messages) return;
        for (const message of messages) {
            this.receive(message);
            if (message instanceof ArrayBuffer && new DataView(message).getUint32(0, true) === FRAME) this.shown++;
        }
        if (this.shown < 2 || this.isSeen) this.port.postMessage({ taken: true });
        else this.whenSeen(() => {
            this.port.postMessage({ taken: true, drawn: true });
            window.parent.postMessage({ jostle: "moves" }, location.origin); // from the first frame to the second one
        });
    }

    /** Calls `then` once the crowd is in the picture. */
    whenSeen(then) {
        const look = () => {
            this.isSeen = !document.getElementById("stage").classList.contains("empty");
            if (this.isSeen) then();
            else requestAnimationFrame(look);
        };
        requestAnimationFrame(look);
    }

    send(command) {
        if (!this.isOpen) {
            this.unsent++;
            return false;
        }
        this.port.postMessage({ command: JSON.stringify(command) });
        return true;
    }
}
