// Pictures to film, and a drawer without OpenGL.
#pragma once

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <csignal>
#include <functional>
#include <memory>
#include <string>

#include "render/film/production/film_maker.hpp"
#include "render/picture/base/shot.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel::test {

class FilmTest : public ::testing::Test {
  protected:
    const TemporaryFolder folder;
};

// While this lives, no file of this process grows beyond `bytes`. This stands for a full disk.
class FileSizeLimit {
  public:
    explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;

  private:
    rlimit before_{};
    void (*handler_)(int);
};

inline Picture flat(int width, int height, int red, int green, int blue) {
    Picture picture(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            std::uint8_t* p = picture.pixel(x, y);
            p[0] = static_cast<std::uint8_t>(red);
            p[1] = static_cast<std::uint8_t>(green);
            p[2] = static_cast<std::uint8_t>(blue);
            p[3] = 255;
        }
    return picture;
}

// A soft orange ball on white. It moves to the right and is back at the left edge after 32 frames.
inline Picture ball(int width, int height, int number) {
    Picture picture = flat(width, height, 255, 255, 255);
    const double radius = height / 3.0, cx = width * (number % 32 + 0.5) / 32, cy = height / 2.0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double light = 1 - std::hypot(x - cx, y - cy) / radius;
            if (light <= 0) continue;
            picture.pixel(x, y)[0] = static_cast<std::uint8_t>(255 - 25 * light);
            picture.pixel(x, y)[1] = static_cast<std::uint8_t>(255 - 96 * light);
            picture.pixel(x, y)[2] = static_cast<std::uint8_t>(255 - 255 * light);
        }
    return picture;
}

// Eighty discs that move over grey. They are hard enough for an encoder that the size can be controlled.
inline Picture discs(int width, int height, int number) {
    Picture picture = flat(width, height, 235, 235, 235);
    const double radius = height / 14.0;
    for (int disc = 0; disc < 80; ++disc) {
        const double turn = 2.399963 * disc, speed = 0.3 + 0.02 * disc;  // the golden angle
        const double cx =
            width * (0.5 + 0.48 * std::cos(turn + 0.02 * speed * number) * std::sqrt((disc + 1) / 80.0));
        const double cy =
            height * (0.5 + 0.48 * std::sin(turn + 0.03 * speed * number) * std::sqrt((disc + 1) / 80.0));
        for (int y = std::max(0, static_cast<int>(cy - radius)); y < std::min<double>(height, cy + radius);
             ++y)
            for (int x = std::max(0, static_cast<int>(cx - radius)); x < std::min<double>(width, cx + radius);
                 ++x) {
                const double light = 1 - std::hypot(x - cx, y - cy) / radius;
                if (light <= 0) continue;
                picture.pixel(x, y)[0] =
                    static_cast<std::uint8_t>(disc % 3 == 0 ? 40 + 200 * light : 230 * light);
                picture.pixel(x, y)[1] =
                    static_cast<std::uint8_t>(disc % 3 == 0 ? 90 + 100 * light : 159 * light);
                picture.pixel(x, y)[2] = static_cast<std::uint8_t>(disc % 3 == 0 ? 180 : 40 * light);
            }
    }
    return picture;
}

// Noise that no encoder can make small.
inline Picture noise(int width, int height, int number) {
    Picture picture(width, height);
    std::uint32_t state = 12345u + static_cast<std::uint32_t>(number);
    for (std::uint8_t& byte : picture.rgba) {
        state = state * 1664525u + 1013904223u;
        byte = static_cast<std::uint8_t>(state >> 24);
    }
    return picture;
}

// Draws the picture that `paint` gives for a frame.
class PaintingDrawer final : public Drawer {
  public:
    explicit PaintingDrawer(std::function<Picture(const State&)> paint) : paint_(std::move(paint)) {}
    void draw(const Shots& frames, const std::string&, Picture& into) override {
        into = paint_(*frames.front());
    }
    std::string description() const override { return "painted"; }

  private:
    std::function<Picture(const State&)> paint_;
};

inline DrawerMaker painting(std::function<Picture(const State&)> paint) {
    return [paint = std::move(paint)] { return std::make_unique<PaintingDrawer>(paint); };
}

// A grey by which frames are told apart: neighbours differ by at least 7 levels, and the greys repeat after
// 37 frames.
inline int grey_of(std::int64_t step) {
    return 2 + static_cast<int>(step * 15 % 37) * 7 % 259 % 252;
}

inline FilmedScene small_scene(int width = 96, int height = 64) {
    FilmedScene scene;
    scene.name = "teaching";
    scene.title = scene.film.title = "Γ = 3, big and small";
    scene.film.width = width;
    scene.film.height = height;
    scene.run.duration = 10;
    return scene;
}

inline std::shared_ptr<Shot> shot_at(std::int64_t step, double interval = 0.1) {
    auto shot = std::make_shared<Shot>();
    shot->step = step;
    shot->time = static_cast<double>(step) * interval;
    return shot;
}

}  // namespace grainreel::test
