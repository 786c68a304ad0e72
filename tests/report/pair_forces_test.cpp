// Tests of force chains in the page, read back in the form that pair_forces.hpp describes.
#include "render/page/bed/page_bed.hpp"

#include <gtest/gtest.h>
#include <libdeflate.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

namespace grainreel {
namespace {

struct Pair {
    int first = 0, second = 0;
    double force = 0;
};

std::vector<std::uint8_t> unpacked(const PairForces& forces) {
    std::size_t pairs = 0;
    for (const PairForces::Moment& one : forces.moments) pairs += one.pairs;
    std::vector<std::uint8_t> bytes(7 * pairs);
    const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> unpacker(
        libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
    EXPECT_EQ(libdeflate_zlib_decompress(unpacker.get(), forces.packed.data(), forces.packed.size(),
                                         bytes.data(), bytes.size(), nullptr),
              LIBDEFLATE_SUCCESS);
    return bytes;
}

std::vector<std::vector<Pair>> read_back(const PairForces& forces) {
    const std::vector<std::uint8_t> bytes = unpacked(forces);
    std::vector<std::vector<Pair>> moments;
    std::size_t at = 0;
    for (const PairForces::Moment& one : forces.moments) {
        const std::size_t n = one.pairs;
        const auto number = [&](std::size_t plane, std::size_t i) {
            return bytes[at + plane * n + i] + 256 * bytes[at + (plane + 1) * n + i] +
                   65536 * bytes[at + (plane + 2) * n + i];
        };
        std::vector<Pair> pairs(n);
        int before = 0;
        for (std::size_t i = 0; i < n; ++i) {
            before += number(0, i);
            const int byte = bytes[at + 6 * n + i];
            pairs[i] = {before, number(3, i),
                        forces.lowest * std::pow(forces.highest / forces.lowest, (byte - 1) / 253.0)};
        }
        moments.push_back(pairs);
        at += 7 * n;
    }
    return moments;
}

// The places of grains by their ids: ids 10, 20, ... have the places 0, 1, ...
std::map<std::int32_t, std::size_t> places(std::size_t grains) {
    std::map<std::int32_t, std::size_t> slots;
    for (std::size_t i = 0; i < grains; ++i) slots[static_cast<std::int32_t>(10 * (i + 1))] = i;
    return slots;
}

TEST(PairForces, PairsAndForcesAreReadBack) {
    std::mt19937 random(3);
    std::uniform_int_distribution<std::int32_t> id(1, 90'000);
    std::uniform_real_distribution<double> decade(-4.9, 0);
    std::vector<std::vector<Link>> moments(3);
    for (auto& touches : moments)
        for (int k = 0; k < 500; ++k)
            touches.push_back({10 * id(random), 10 * id(random), std::pow(10, decade(random))});
    moments[1].push_back({10, -1, 1.0});  // the strongest contact
    moments[1].push_back({10, -6, 0.5});
    PairForcesWriter writer;
    const auto slots = places(90'000);
    for (std::size_t k = 0; k < 3; ++k) writer.add(10 * k, moments[k], slots);
    const PairForces forces = writer.written();
    EXPECT_EQ(forces.highest, 1.0);
    const auto read = read_back(forces);
    ASSERT_EQ(read.size(), 3u);
    const double off = std::pow(1e5, 0.5 / 253);  // half a step of the byte
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(forces.moments[k].moment, 10 * k);
        std::stable_sort(moments[k].begin(), moments[k].end(),
                         [](const Link& a, const Link& b) { return a.first < b.first; });
        ASSERT_EQ(read[k].size(), moments[k].size());
        for (std::size_t i = 0; i < read[k].size(); ++i) {
            const Link& touch = moments[k][i];
            EXPECT_EQ(read[k][i].first, touch.first / 10 - 1);
            const int second = touch.second < 0 ? 0xffffff - (-1 - touch.second) : touch.second / 10 - 1;
            EXPECT_EQ(read[k][i].second, second);
            EXPECT_LE(std::max(read[k][i].force / touch.force, touch.force / read[k][i].force),
                      off * (1 + 1e-9));
        }
    }
}

TEST(PairForces, WhatThePageLacksAndWhatPushesNobodyIsLeftOut) {
    PairForcesWriter writer;
    writer.add(0, {{10, 20, 0.5}, {10, 15, 0.5}, {15, 20, 0.5}, {20, 30, 0.0}, {15, -1, 0.5}}, places(3));
    const auto read = read_back(writer.written());
    ASSERT_EQ(read[0].size(), 1u);
    EXPECT_EQ(read[0][0].first, 0);
    EXPECT_EQ(read[0][0].second, 1);
}

TEST(PairForces, NoMomentsTakeNoBytes) {
    EXPECT_TRUE(PairForcesWriter().written().packed.empty());
}

}  // namespace
}  // namespace grainreel
