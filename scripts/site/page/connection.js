// The live page's connection in the playground: the build puts it in the place of core/view/page/net/connection.js. Messages come
// by a port from the engine's worker, which gets an answer to each batch and sends the next one then: a slow page gets the newest only.
import { Connection as Socket } from "../../../core/view/page/net/connection.js";

export const LINK_WORDS = { connecting: "Loading the engine", connected: "The engine is loaded" };

export class Connection extends Socket {
    open() {
        this.isOpen = false;
        this.handlers.state("connecting");
        const { port1, port2 } = new MessageChannel();
        this.port = port1;
        port1.onmessage = ({ data }) => this.takeBatch(data);
        window.parent.postMessage({ jostle: "connect" }, location.origin, [port2]);
    }

    /** Takes {open} once a scene runs, or {messages}: texts and buffers. */
    takeBatch({ open, messages }) {
        if (open) {
            this.isOpen = true;
            this.handlers.state("open");
        }
        if (!messages) return;
        for (const message of messages) this.receive(message);
        if (this.frames > 1 && !this.seen) this.tellWhenSeen();
        this.port.postMessage({ taken: true });
    }

    /** Tells the workbench once the crowd is in the picture, and moves: it loads the editor then. */
    tellWhenSeen() {
        this.seen = true;
        const look = () => {
            if (document.getElementById("stage").classList.contains("empty")) requestAnimationFrame(look);
            else window.parent.postMessage({ jostle: "moves" }, location.origin);
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
