// The one moment that film, charts and bed show: a time of the run, in seconds.
class RunTime {
    constructor(begin, end) {
        this.begin = begin;
        this.end = end;
        this.now = begin;
        this.isLive = false; // when true, only the run moves the time
        this.listeners = [];
    }

    /** listener(time, source): source is the part that moved the time; it need not follow itself. */
    listen(listener) {
        this.listeners.push(listener);
    }

    set(time, source) {
        if (this.isLive && source !== "run") return;
        const now = Math.min(this.end, Math.max(this.begin, time));
        if (!Number.isFinite(now)) return;
        this.now = now;
        for (const listener of this.listeners) listener(now, source);
    }
}

/** The bar with the slider over the run's time, the buttons, and the words about the moment. */
class TimeBar {
    /** steps: the times that the buttons go through. */
    constructor(runTime, steps, drive) {
        this.runTime = runTime;
        this.steps = steps;
        this.drive = drive;
        this.slider = document.getElementById("time");
        this.words = document.getElementById("time-words");
        this.playing = null;
        this.player = null; // player of the film, if there is one
        this.stepping = {play: () => this.playSteps(), pause: () => this.stopSteps()};
        this.slider.min = 0;
        this.slider.max = 1000;
        this.slider.step = 1;
        this.slider.addEventListener("input", () => {
            const share = Number(this.slider.value) / 1000;
            runTime.set(runTime.begin + share * (runTime.end - runTime.begin), this);
        });
        this.slider.addEventListener("keydown", (event) => this.key(event));
        document.getElementById("back").addEventListener("click", () => this.step(-1));
        document.getElementById("on").addEventListener("click", () => this.step(1));
        this.button = document.getElementById("play");
        this.button.addEventListener("click", () => (this.isPlaying ? this.whoPlays().pause() : this.whoPlays().play()));
        runTime.listen((time, source) => this.show(time, source));
        this.show(runTime.now, null);
    }

    whoPlays() {
        return this.player ?? this.stepping;
    }

    key(event) {
        const by = {ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1, PageDown: -10, PageUp: 10}[event.key];
        if (by === undefined) return;
        event.preventDefault();
        this.step(by);
    }

    /** Goes to the next step, or to the one before. */
    step(by) {
        this.whoPlays().pause();
        const at = nearestIndex(this.steps, this.runTime.now);
        this.runTime.set(this.steps[Math.min(this.steps.length - 1, Math.max(0, at + by))], "step");
    }

    show(time, source) {
        const span = this.runTime.end - this.runTime.begin || 1;
        if (source !== this) this.slider.value = Math.round((1000 * (time - this.runTime.begin)) / span);
        const text = this.drive ? tr("{1} s, period {2}", time.toFixed(3), (time * this.drive).toFixed(2)) : `${time.toFixed(3)} s`;
        this.words.textContent = text;
        this.slider.setAttribute("aria-valuetext", text);
    }

    /** To be called by the player when it starts or stops, since the film can also be started by its own buttons. */
    setPlaying(is) {
        this.isPlaying = is;
        this.button.textContent = tr(is ? "Pause" : "Play");
    }

    // Without a film this plays the bed's moments, twelve a second.
    playSteps() {
        this.setPlaying(true);
        let at = nearestIndex(this.steps, this.runTime.now);
        if (at + 1 >= this.steps.length) at = -1;
        this.playing = setInterval(() => {
            if (at + 1 >= this.steps.length) return this.stopSteps();
            this.runTime.set(this.steps[++at], "play");
        }, 1000 / 12);
    }

    stopSteps() {
        clearInterval(this.playing);
        this.setPlaying(false);
    }
}
