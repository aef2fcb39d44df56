// When the worker's next turn is. Timers of browsers wait 4 ms at least, so what is due at once comes as a message.

/** Returns schedule(seconds): `work` is called once after so long, whatever was scheduled before. */
export function makeSchedule(work) {
    const soon = new MessageChannel();
    let timer = 0, isDue = false;
    soon.port1.onmessage = () => {
        isDue = false;
        work();
    };
    return (seconds) => {
        clearTimeout(timer);
        if (isDue) return; // a second message would make two chains of turns, and commands would wait for both
        if (seconds > 0.001) {
            timer = setTimeout(work, 1000 * seconds);
            return;
        }
        isDue = true;
        soon.port2.postMessage(null);
    };
}
