// The film, from the page's own bytes, tied to the run's time by a table of frames.
class FilmPanel {
    /** film: facts {rate, type, times}; times[k] is the run's time in s that frame k shows; times may be empty. */
    constructor(film, bytes, runTime, bar, n = "") {
        this.n = n; // ending of the ids of its elements, when the page has several films
        this.others = []; // films beside this one
        this.leads = true; // whether this film leads the others: its frames are the page's moment
        this.film = film;
        this.runTime = runTime;
        this.video = document.getElementById("film" + n);
        this.wanted = null; // frame to seek when the present seek has ended
        this.follows = false; // whether the last seek came from chart, bed or bar
        const blob = new Blob([bytes], {type: film.type});
        this.video.src = URL.createObjectURL(blob);
        this.tied = film.times.length > 0;
        this.showStart();
        this.video.addEventListener("play", () => this.begun(bar));
        this.video.addEventListener("pause", () => this.ended(bar));
        this.video.addEventListener("seeked", () => this.seekWanted());
        this.video.addEventListener("seeking", () => this.noteSeek());
        this.video.addEventListener("error", () => this.say(tr("This browser cannot play the film.")));
        bar.player ??= {play: () => this.play(), pause: () => this.pause()};
        if (!this.tied) return;
        this.takeOverControls();
        this.watchFrames();
        runTime.listen((time, source) => {
            if (source !== this) this.seek(time);
        });
    }

    // Film, bed and charts begin at one moment: the first frame replaces the poster, which may show another moment.
    showStart() {
        this.wanted = 0;
        this.video.addEventListener("loadeddata", () => this.seekWanted(), {once: true});
    }

    // The page's bar plays the film. The browser's own controls would lie over the film's words.
    takeOverControls() {
        const {video} = this;
        video.controls = false;
        video.classList.add("tied");
        video.addEventListener("click", () => (video.paused ? this.play() : this.pause()));
        if (!video.requestFullscreen) return;
        const button = element("button", {type: "button"}, tr("Full screen"));
        button.addEventListener("click", () => video.requestFullscreen());
        video.addEventListener("fullscreenchange", () => (video.controls = document.fullscreenElement === video));
        video.after(element("p", {className: "no-print"}, button));
    }

    // Called when the film has been started, by the bar or by its own buttons. Other films that show the same moments
    // play along; the rest follow by seeking.
    begun(bar) {
        if (this.goesAlong) return;
        this.follows = false;
        bar.setPlaying(true);
        this.leads = true;
        for (const other of this.others) {
            other.leads = false;
            if (!other.tied || !sameTimes(other.film, this.film)) continue;
            other.goesAlong = true;
            other.video.currentTime = this.video.currentTime;
            other.play();
        }
    }

    ended(bar) {
        if (this.goesAlong) return;
        bar.setPlaying(false);
        for (const other of this.others) {
            if (!other.goesAlong) continue;
            other.video.pause();
            other.goesAlong = false;
        }
    }

    pause() {
        for (const film of [this, ...this.others]) if (!film.goesAlong) film.video.pause();
    }

    play() {
        this.video.play().catch((reason) => this.say(tr("The film does not play: {1}.", reason.message)));
    }

    say(text) {
        document.getElementById("film-says" + this.n).textContent = text;
    }

    // Notices each frame as it is shown. If the browser does not report frames, the film's clock is used. When the film
    // stops the clock is used in any case, since a busy browser leaves out frames.
    watchFrames() {
        this.video.addEventListener("pause", () => this.shown(this.video.currentTime));
        if (!this.video.requestVideoFrameCallback) {
            this.video.addEventListener("timeupdate", () => this.shown(this.video.currentTime));
            return;
        }
        const next = (now, frame) => {
            // When a film has stopped, a frame that is reported late is not the one where it stopped.
            const stopped = this.video.paused && !this.video.seeking;
            this.shown(stopped ? this.video.currentTime : frame.mediaTime);
            this.video.requestVideoFrameCallback(next);
        };
        this.video.requestVideoFrameCallback(next);
    }

    shown(seconds) {
        const frame = Math.min(this.film.times.length - 1, Math.floor(seconds * this.film.rate + 0.01));
        this.frame = frame;
        const of = this.film.times.length;
        this.say(tr("Frame {1} of {2}, {3} s of the run.", frame + 1, of, this.film.times[frame].toFixed(3)));
        if (this.leads && !this.follows) this.runTime.set(this.film.times[frame], this);
    }

    /** Goes to the frame that is nearest to the run's time. */
    seek(time) {
        const wanted = nearestIndex(this.film.times, time);
        const mostLate = 2; // frames by which a film that plays along may lag
        if (this.goesAlong && Math.abs(wanted - (this.frame ?? wanted)) <= mostLate) return;
        if (!this.goesAlong) this.video.pause();
        this.wanted = wanted;
        if (!this.video.seeking) this.seekWanted();
    }

    seekWanted() {
        if (this.wanted === null) return;
        const seconds = (this.wanted + 0.5) / this.film.rate;
        this.wanted = null;
        this.follows = true;
        this.ownSeek = seconds;
        this.video.currentTime = seconds;
    }

    // A seek by the film's own buttons moves the run's time.
    noteSeek() {
        if (this.ownSeek !== undefined && Math.abs(this.video.currentTime - this.ownSeek) < 1e-3) return;
        this.follows = false;
    }
}

function sameTimes(a, b) {
    return a.rate === b.rate && a.times.length === b.times.length && a.times.every((time, k) => Math.abs(time - b.times[k]) < 1e-9);
}
