#include "render/film/production/film_maker.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

#include "engine/base/error.hpp"
#include "render/film/production/bounded_queue.hpp"
#include "render/film/production/picture_files.hpp"
#include "render/film/sampling/film_frames.hpp"
#include "render/picture/camera/camera_path.hpp"
#include "render/picture/whole/renderer.hpp"
#include "render/scene/filmed_scene.hpp"

namespace grainreel {

namespace {

using Watch = std::chrono::steady_clock;

double seconds_since(Watch::time_point start) {
    return std::chrono::duration<double>(Watch::now() - start).count();
}

// The queues are deep enough that an uneven engine or encoder rarely makes the other stages wait. A picture
// has 8 MB at 1080p.
constexpr std::size_t waiting_frames = 4, waiting_pictures = 2;

// These constants apply when engine and film take turns. At the beginning and end of each turn some stage has
// nothing to do, so turns are long: up to as many frames as 64 MB hold. An engine that needs longer than the
// patience for one frame does not have to fill the queue: the film then starts with what is there.
constexpr std::int64_t turn_bytes = 64 << 20, bytes_a_grain = 250, longest_turn = 32;
constexpr std::chrono::milliseconds turn_patience(250);
constexpr std::chrono::milliseconds glance(50);  // how often the caller is asked whether it is in a hurry

std::size_t frames_that_wait(const FilmedScene& scene, const FilmOptions& options) {
    if (!options.take_turns) return waiting_frames;
    std::int64_t moments = 1;  // number of moments that a picture is exposed over
    for (const FilmSegment& segment : scene.film.segments)
        if (segment.exposure > 0) moments = std::max<std::int64_t>(moments, segment.exposures);
    const std::int64_t fit =
        turn_bytes / (bytes_a_grain * moments * std::max<std::int64_t>(1, scene.grains()));
    return static_cast<std::size_t>(std::clamp<std::int64_t>(fit, waiting_frames, longest_turn));
}
// Number of pictures that exist at once: those in the queue, the one being drawn, the one being encoded, and
// the last one, which is kept for the poster.
constexpr std::size_t pictures_in_all = waiting_pictures + 3;

struct Order {
    Shots shots;
    std::string playback;
    std::int64_t more = 0;  // how many more times the film shows the picture
    bool drawn = true;      // false: the shots are only remembered
};
struct Drawn {
    DrawnShot frame;
    std::int64_t more;
};

}  // namespace

struct FilmMaker::Impl {
    Impl(const FilmedScene& scene, const FilmOptions& options, DrawerMaker make_drawer)
        : holds(scene.film),
          files(scene, options),
          make(std::move(make_drawer)),
          frames(frames_that_wait(scene, options),
                 options.take_turns ? turn_patience : std::chrono::milliseconds(0)) {
        for (const double time : options.extent.earlier) holds.begin_at(time);
        for (std::size_t i = 0; i < pictures_in_all; ++i) spare.push(Picture());
        drawing = std::thread([this] { guarded(&Impl::draw_all); });
        encoding = std::thread([this] {
            guarded(&Impl::encode_all);
            tell_end();
        });
    }

    ~Impl() {
        cancel();
        join();
    }

    // Runs one stage; its failure stops the other one and is kept for the caller.
    void guarded(void (Impl::*stage)()) {
        try {
            (this->*stage)();
        } catch (const std::exception& error) {
            fail(error.what());
        } catch (...) {
            fail("the film failed for an unknown reason");
        }
    }

    void draw_all() {
        const std::unique_ptr<Drawer> drawer = make();
        gl = drawer->description();
        note = drawer->note();
        tell_drawer();
        while (std::optional<Order> order = frames.pop()) {
            if (!order->drawn) {
                drawer->remember(order->shots);
                continue;
            }
            std::optional<Picture> canvas = spare.pop();
            if (!canvas) return;
            const Watch::time_point start = Watch::now();
            drawer->draw(order->shots, order->playback, *canvas);
            draw_seconds += seconds_since(start);
            pictures.push({{std::move(*canvas), std::move(order->shots.front()), std::move(order->playback)},
                           order->more});
        }
        last_note = drawer->last_note();
        pictures.close();
    }

    void encode_all() {
        while (std::optional<Drawn> drawn = pictures.pop()) {
            const Watch::time_point start = Watch::now();
            for (; drawn->more > 0; --drawn->more) files.add(drawn->frame);
            spare.push(files.add(std::move(drawn->frame)));
            encode_seconds += seconds_since(start);
        }
        const Watch::time_point start = Watch::now();
        const bool whole = complete;
        if (!whole) files.leave();
        files.close_poster();
        if (whole) files.finish();
        encode_seconds += seconds_since(start);
    }

    // Waits until the film has ended, with success or without.
    void wait_for_end(const std::function<bool()>& in_a_hurry) {
        std::unique_lock lock(end_mutex);
        const auto has_ended = [this] { return ended; };
        while (!ended) {
            if (in_a_hurry && in_a_hurry()) {
                complete = false;
                cancel();
                end_told.wait(lock, has_ended);
            }
            end_told.wait_for(lock, glance, has_ended);
        }
    }

    void tell_end() {
        {
            const std::scoped_lock lock(end_mutex);
            ended = true;
        }
        end_told.notify_all();
    }

    void fail(const std::string& words) {
        {
            const std::scoped_lock lock(failure_mutex);
            if (failure.empty()) failure = words;
        }
        tell_drawer();
        cancel();
    }

    void tell_drawer() {
        drawer_known = true;
        drawer_known.notify_all();
    }

    void cancel() {
        frames.cancel();
        pictures.cancel();
        spare.cancel();
    }

    void join() {
        if (drawing.joinable()) drawing.join();
        if (encoding.joinable()) encoding.join();
    }

    void throw_failure() {
        const std::scoped_lock lock(failure_mutex);
        if (!failure.empty()) throw RunError(failure);
    }

    CaptionHolds holds;  // used by the thread that calls take()
    PictureFiles files;  // used by the encoding thread alone, once it runs
    DrawerMaker make;
    BoundedQueue<Order> frames;
    BoundedQueue<Drawn> pictures{waiting_pictures};
    BoundedQueue<Picture> spare{pictures_in_all};
    std::atomic<bool> complete = false;  // finish() was called: the film is closed, not abandoned
    std::mutex end_mutex;
    std::condition_variable end_told;
    bool ended = false;  // the encoding thread has done its work
    std::mutex failure_mutex;
    std::string failure;                     // words of the stage that failed first; empty when none did
    std::atomic<bool> drawer_known = false;  // the drawer is made, or something failed
    std::string gl, note;  // what the drawer says of itself; to be read once drawer_known is set
    // The members from here on are written by one thread and read after join().
    std::string last_note;  // last note of the drawer
    double draw_seconds = 0, encode_seconds = 0, waited_seconds = 0;
    std::thread drawing, encoding;
};

FilmMaker::FilmMaker(const FilmedScene& scene, const FilmOptions& options, DrawerMaker make_drawer)
    : impl_(std::make_unique<Impl>(scene, options, std::move(make_drawer))) {}

FilmMaker::~FilmMaker() = default;

void FilmMaker::take(Shots shots, std::string playback) {
    GRAINREEL_CHECK(!impl_->complete && !shots.empty());
    const Watch::time_point start = Watch::now();
    const std::int64_t more = impl_->holds.begin_at(shots.front()->time);
    const bool taken = impl_->frames.push({std::move(shots), std::move(playback), more});
    impl_->waited_seconds += seconds_since(start);
    if (!taken) impl_->throw_failure();
}

void FilmMaker::remember(ShotPtr shot) {
    GRAINREEL_CHECK(!impl_->complete && shot);
    if (!impl_->frames.push({.shots = {std::move(shot)}, .playback = "", .drawn = false}))
        impl_->throw_failure();
}

std::string FilmMaker::drawer() {
    impl_->drawer_known.wait(false);
    impl_->throw_failure();
    return impl_->gl;
}

FilmResult FilmMaker::finish(const std::function<bool()>& in_a_hurry) {
    impl_->complete = true;
    impl_->frames.close();
    impl_->wait_for_end(in_a_hurry);
    impl_->join();
    impl_->throw_failure();
    FilmResult result;
    result.complete = impl_->files.complete();
    result.frames = impl_->files.frames();
    result.draw_seconds = impl_->draw_seconds;
    result.encode_seconds = impl_->encode_seconds;
    result.waited_seconds = impl_->waited_seconds;
    result.gl = impl_->gl;
    result.file = impl_->files.film_file();
    result.pictures = impl_->files.has_frames();
    result.poster = impl_->files.has_poster();
    result.sheet = impl_->files.has_sheet();
    result.encoder = impl_->files.encoder();
    result.notes = impl_->files.notes();
    for (const std::string& note : {impl_->note, impl_->last_note})
        if (!note.empty()) result.notes.push_back(note);
    return result;
}

std::int64_t FilmMaker::frames_done() const {
    return impl_->files.frames();
}

// This is the only place where the production line meets OpenGL.

namespace {

class RendererDrawer final : public Drawer {
  public:
    RendererDrawer(const FilmedScene& scene, const FilmOptions& options)
        : renderer_(with_orbit(scene, options), options.raster_threads, options.gl),
          rate_(scene.film.rate),
          drawn_(static_cast<std::int64_t>(options.extent.earlier.size())) {
        if (options.start) renderer_.start_from(*options.start);
    }
    void draw(const Shots& shots, const std::string& playback, Picture& into) override {
        renderer_.draw_into(into, *shots.front(), playback, static_cast<double>(drawn_++) / rate_);
    }
    void remember(const Shots& shots) override { renderer_.remember(*shots.front()); }
    std::string description() const override { return renderer_.gl_description(); }
    std::string note() const override { return renderer_.gl_note(); }
    std::string last_note() const override { return renderer_.last_note(); }

  private:
    static FilmedScene with_orbit(FilmedScene scene, const FilmOptions& options) {
        settle_orbit(scene.film.camera, static_cast<double>(options.pictures) / scene.film.rate);
        return scene;
    }

    Renderer renderer_;
    const double rate_;
    std::int64_t drawn_;  // pictures of the film drawn so far, those of earlier parts included
};

}  // namespace

FilmMaker::FilmMaker(const FilmedScene& scene, const FilmOptions& options)
    : FilmMaker(scene, options,
                [scene, options] { return std::make_unique<RendererDrawer>(scene, options); }) {}

}  // namespace grainreel
