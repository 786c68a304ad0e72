// Finds which grain is seen in the middle of each pixel, and which may be seen in a pixel on an edge. Grains
// are exact spheres that the pixel's line of sight meets.
//
// This runs on the processor's vector units and not in OpenGL. The depth of a sphere is known only pixel by
// pixel, so a software rasteriser could not use its early depth test. docs/notes/rendering.md has the
// measurements. The file is hot: time it after a change (`grainreel bench`).
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/base/team.hpp"
#include "render/picture/spheres/sphere_kernels.hpp"

namespace grainreel {

// The marked pixels of a row.
class RowBits {
  public:
    // Gives room for a row of `width` pixels. All pixels must be written before they are read.
    std::uint64_t* room(int width) {
        width_ = width;
        words_.resize(static_cast<std::size_t>(width) / 64 + 1);
        words_.back() = 0;
        return words_.data();
    }
    bool at(int x) const { return words_[static_cast<std::size_t>(x) / 64] >> (x % 64) & 1; }
    // The first marked pixel from x on, or the width.
    int next(int x) const {
        if (x >= width_) return width_;
        std::size_t word = static_cast<std::size_t>(x) / 64;
        std::uint64_t left = words_[word] & (~std::uint64_t{0} << (x % 64));
        while (left == 0 && ++word < words_.size()) left = words_[word];
        return left ? static_cast<int>(word * 64) + std::countr_zero(left) : width_;
    }

  private:
    int width_ = 0;
    std::vector<std::uint64_t> words_;
};

// m: z of solid things that may hide grains, in the middle of each pixel; infinite where there is nothing.
// Rows have `stride` numbers.
struct SolidDepth {
    const float* away = nullptr;  // null: nothing anywhere
    std::size_t stride = 0;
};

// The grains of a picture: a sphere around each, and what is in it.
struct DrawnGrains {
    DrawnGrains(const std::vector<ViewSphere>& spheres) : around(spheres) {}
    DrawnGrains(const std::vector<ViewSphere>& spheres, const std::vector<ViewShape>& inside)
        : around(spheres), shapes(inside.empty() ? nullptr : inside.data()) {}

    const std::vector<ViewSphere>& around;
    const ViewShape* shapes = nullptr;  // one for each grain; null: all are the spheres themselves
};

class Visibility {
  public:
    // width, height: pixels, >= 1.
    Visibility(int width, int height);

    // The number of a grain is its index + 1. The result does not depend on the team's size. Where `solid` is
    // given, grains are seen only where they are nearer than it, and depths are kept.
    void update(const Sight& sight, const Cut& cut, const DrawnGrains& grains, Team& team,
                const SolidDepth& solid = {});

    // Number of the grain seen in each pixel of a row, or 0. Rows count from the top. One pixel before the
    // first and 16 after the last may be read; those next to the row repeat its ends.
    const std::uint32_t* row(int y) const {
        return seen_.data() + static_cast<std::size_t>(y) * stride_ + kPad;
    }
    // m: z of the grain or solid that is seen in the middle of each pixel of a row. Depths are kept only
    // where update() was given something solid.
    const float* depth(int y) const { return depth_.data() + static_cast<std::size_t>(y) * stride_ + kPad; }
    std::size_t stride() const { return stride_; }  // numbers from row to row
    // The indices of the grains that are seen at all, rising.
    const std::vector<std::uint32_t>& shown() const { return shown_; }
    // The pixels of this picture that a sphere covers.
    PixelBox bounds(const Sight& sight, const ViewSphere& sphere) const;
    // The pixels that a grain may be seen in; none for a grain that is cut away.
    const PixelBox& box(std::size_t grain) const { return box_[grain]; }
    // The share of the area inside a grain's outline that shows the grain.
    double seen_share(std::size_t grain) const;
    int width() const { return width_; }
    int height() const { return height_; }

  private:
    static constexpr int kPad = 16, kBand = 32, kTile = 32;  // pixels
    struct Worker {
        std::vector<float> depth;
        std::vector<float> far;              // for each tile: nothing behind this depth can be seen
        std::vector<int> drawn;              // for each tile: grains drawn since `far` was found
        std::vector<std::uint32_t> seen_in;  // for each grain: the last band in which it was seen
        std::vector<std::uint32_t> shown;
        RowBits changes;
    };

    void place(const Sight& sight, const Cut& cut, const std::vector<ViewSphere>& spheres, Team& team);
    void sort_nearest_first(const std::vector<ViewSphere>& spheres);
    void fill_bands();
    void draw_band(int band, Worker& worker, const Sight& sight, const Cut& cut, const DrawnGrains& grains,
                   const SolidDepth& solid);
    float* depth_of_band(int band, Worker& worker, const SolidDepth& solid);
    bool hidden(Worker& worker, int band, const PixelBox& box, float nearest, const struct DepthRows& rows);
    void note_shown(int band, Worker& worker);
    void collect_shown(std::size_t count);
    int bands() const { return (height_ + kBand - 1) / kBand; }

    const int width_, height_;
    const std::size_t stride_;
    std::vector<std::uint32_t> seen_;
    std::vector<float> depth_;  // empty unless something solid was given
    std::vector<float> slope_x_;
    std::vector<PixelBox> box_;
    std::vector<std::uint32_t> order_;
    std::vector<std::vector<std::uint32_t>> band_;  // grains in each band, nearest first
    std::vector<Worker> workers_;
    std::vector<std::uint32_t> shown_;
};

// Puts pixel x, y into place `at` of the block, with the different grains that it and its four neighbours
// show. These grains may be seen in the pixel. who: gets their indices.
void take_candidates(const Visibility& visibility, const std::vector<ViewSphere>& spheres, int x, int y,
                     EdgeBlock& block, std::uint32_t (&who)[kCandidates][kPointBlock], int at);

// Leaves the places from `begin` on without candidates.
void clear_candidates(EdgeBlock& block, int begin);

// Computes the results of a block whose candidates are `who`.
void settle_candidates(const Sight& sight, const Cut& cut, const ViewShape* shapes,
                       const std::uint32_t (&who)[kCandidates][kPointBlock], EdgeBlock& block);

}  // namespace grainreel
