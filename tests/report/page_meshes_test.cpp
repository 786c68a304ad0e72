// Tests of meshes in the page, read back in the form that page_meshes.hpp describes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <libdeflate.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

#include "render/page/bed/page_meshes.hpp"
#include "tests/report/made_meshes.hpp"

namespace grainreel {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::size_t plenty = 10'000'000;  // bytes

FilmedScene scene_with(std::vector<TriangleMesh> meshes) {
    FilmedScene scene;
    scene.container.shape = Container::Shape::none;
    for (TriangleMesh& mesh : meshes) {
        SceneMesh one;
        one.name = "part " + std::to_string(scene.meshes.size() + 1);
        one.surface.of = test::surface_of(std::move(mesh));
        scene.meshes.push_back(one);
    }
    return scene;
}

struct Read {
    std::vector<Vec3> vertices;
    std::vector<std::array<std::int64_t, 3>> triangles;
    std::vector<std::array<std::int64_t, 2>> edges;
};

class Reader {
  public:
    explicit Reader(const PageMeshes& page) {
        std::size_t size = 0;
        for (const PageMesh& mesh : page.meshes)
            size += 6 * mesh.vertices + 9 * mesh.triangles + 6 * mesh.edges;
        bytes_.resize(size);
        const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> unpacker(
            libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
        // Null stands for the size: there must be exactly so many bytes.
        EXPECT_EQ(libdeflate_zlib_decompress(unpacker.get(), page.packed.data(), page.packed.size(),
                                             bytes_.data(), size, nullptr),
                  LIBDEFLATE_SUCCESS);
    }

    Read next(const PageMesh& mesh) {
        Read read;
        read.vertices.resize(mesh.vertices);
        for (int axis = 0; axis < 3; ++axis) {
            std::int64_t number = 0;
            const std::vector<std::int64_t> changes = planes(mesh.vertices, 2);
            for (std::size_t i = 0; i < changes.size(); ++i) {
                number = (number + changes[i]) & 0xffff;
                read.vertices[i][axis] =
                    mesh.low[axis] + static_cast<double>(number) / 65535 * (mesh.high[axis] - mesh.low[axis]);
            }
        }
        read.triangles = corners<3>(mesh.triangles);
        read.edges = corners<2>(mesh.edges);
        return read;
    }

  private:
    std::vector<std::int64_t> planes(std::size_t count, int each) {
        std::vector<std::int64_t> numbers(count, 0);
        for (int plane = 0; plane < each; ++plane)
            for (std::int64_t& number : numbers) number += std::int64_t{bytes_[at_++]} << (8 * plane);
        for (std::int64_t& number : numbers) number = number % 2 == 0 ? number / 2 : -(number + 1) / 2;
        return numbers;
    }
    template <std::size_t count>
    std::vector<std::array<std::int64_t, count>> corners(std::size_t of) {
        std::vector<std::array<std::int64_t, count>> list(of);
        for (std::size_t corner = 0; corner < count; ++corner) {
            const std::vector<std::int64_t> changes = planes(of, 3);
            std::int64_t before = 0;
            for (std::size_t i = 0; i < of; ++i) list[i][corner] = before += changes[i];
        }
        return list;
    }

    std::vector<std::uint8_t> bytes_;
    std::size_t at_ = 0;
};

TEST(PageMeshes, ComeBackWithinHalfAStepTheVesselSolidInside) {
    TriangleMesh box, blade;
    test::add_box(box, {-0.05, -0.04, 0}, {0.05, 0.04, 0.06});
    test::add_box(blade, {-0.03, 0.01, 0.01}, {0.03, 0.011, 0.03});
    FilmedScene scene = scene_with({box, blade});
    scene.container.shape = Container::Shape::mesh;
    scene.container.mesh = "part 1";
    const PageMeshes page = page_meshes(scene, plenty);
    ASSERT_EQ(page.meshes.size(), 2u);
    Reader reader(page);
    for (std::size_t k = 0; k < 2; ++k) {
        const PageMesh& mesh = page.meshes[k];
        EXPECT_EQ(mesh.body, kFirstPlaneBody + static_cast<std::int32_t>(k));
        EXPECT_EQ(mesh.name, scene.meshes[k].name);
        EXPECT_EQ(mesh.triangles, 12u);
        EXPECT_EQ(mesh.edges, 12u);
        EXPECT_EQ(mesh.sided, k == 0 ? 12u : 0u) << "glass from outside; solid all round";
        EXPECT_EQ(mesh.glass, 0u);
        const Read read = reader.next(mesh);
        const std::vector<Vec3>& exact = scene.meshes[k].surface->mesh().vertices;
        ASSERT_EQ(read.vertices.size(), exact.size());
        for (std::size_t i = 0; i < exact.size(); ++i)
            for (int axis = 0; axis < 3; ++axis)
                EXPECT_LE(std::abs(read.vertices[i][axis] - exact[i][axis]),
                          0.5001 * (mesh.high[axis] - mesh.low[axis]) / 65535);
        const Vec3 middle = k == 0 ? Vec3(0, 0, 0.03) : Vec3(0, 0.0105, 0.02);
        for (const auto& t : read.triangles) {
            const auto at = [&](std::size_t i) { return read.vertices[static_cast<std::size_t>(t[i])]; };
            const Vec3 normal = (at(1) - at(0)).cross(at(2) - at(0));
            EXPECT_EQ(normal.dot(middle - at(0)) > 0, k == 0);
        }
    }
    EXPECT_THAT(page.notes(), IsEmpty());
}

// A ball of many triangles; none of its edges is sharp.
TriangleMesh ball(int rings) {
    TriangleMesh mesh;
    const auto at = [&](int i, int k) {
        const double theta = std::numbers::pi * i / rings, phi = std::numbers::pi * k / rings;
        return Vec3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
    };
    for (int i = 0; i < rings; ++i)
        for (int k = 0; k < 2 * rings; ++k)
            test::add_quad(mesh, at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1));
    return mesh;
}

TEST(ThinnedMesh, KeepsTheShapeWithinACell) {
    const auto surface = test::surface_of(ball(100));
    constexpr std::size_t most = 2000;
    const ThinnedMesh thin = thinned(surface->mesh(), most);
    ASSERT_LE(thin.mesh.triangles.size(), most);
    ASSERT_GE(thin.mesh.triangles.size(), most / 4);
    const double cell = std::sqrt(2 * 4 * std::numbers::pi / (most / 4.0));
    for (const Vec3& vertex : thin.mesh.vertices) EXPECT_NEAR(vertex.norm(), 1, cell);
    for (std::size_t t = 0; t < thin.mesh.triangles.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i) {
            const auto whole = static_cast<std::size_t>(thin.triangle_from[t]);
            const auto corner = static_cast<std::size_t>(surface->mesh().triangles[whole][i]);
            EXPECT_EQ(thin.mesh.triangles[t][i], thin.vertex_into[corner]);
        }
    EXPECT_EQ(thinned(surface->mesh(), plenty).mesh.triangles, surface->mesh().triangles);
}

TEST(PageMeshes, LargeOnesAreThinnedAndSmallOnesStayWhole) {
    TriangleMesh box;
    test::add_box(box, {2, 2, 2}, {3, 3, 3});
    const FilmedScene scene = scene_with({ball(60), box});
    const PageMeshes page = page_meshes(scene, plenty, 3000);
    EXPECT_LE(page.meshes[0].triangles + page.meshes[1].triangles, 3000u);
    EXPECT_GE(page.meshes[0].triangles, 700u);
    EXPECT_EQ(page.meshes[1].triangles, 12u);
    EXPECT_THAT(page.notes(), ElementsAre(HasSubstr("\"part 1\" is drawn with")));
    Reader reader(page);
    for (const PageMesh& mesh : page.meshes)
        for (const auto& triangle : reader.next(mesh).triangles)
            for (const std::int64_t corner : triangle)
                EXPECT_TRUE(corner >= 0 && corner < static_cast<std::int64_t>(mesh.vertices));
}

TEST(PageMeshes, WhatThePageHasNoRoomForIsLeftOutWithALine) {
    const FilmedScene scene = scene_with({ball(60)});
    const PageMeshes small = page_meshes(scene, 6000);
    EXPECT_LE(small.packed.size(), 6000u);
    EXPECT_GT(small.meshes[0].triangles, 0u);
    const PageMeshes none = page_meshes(scene, 100);
    EXPECT_EQ(none.meshes[0].triangles, 0u);
    EXPECT_THAT(none.packed, IsEmpty());
    EXPECT_THAT(none.notes(), ElementsAre(HasSubstr("the page has no room")));
}

TEST(PageMeshes, TheBoxHasThemAtAllMoments) {
    TriangleMesh box;
    test::add_box(box, {0, -1, 0}, {4, 1, 1});
    const FilmedScene scene = scene_with({box});
    State turned;
    turned.bodies.resize(3);
    turned.bodies[2].rotation = Quaternion(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3(0, 0, 1)));
    turned.bodies[2].place = Vec3(0, 0, 2);
    Extent extent{{0, 0, 0}, {0.1, 0.1, 0.1}};
    take_meshes(extent, scene, {State(), turned});
    EXPECT_LT((extent.low - Vec3(-1, -1, 0)).norm(), 1e-12);
    EXPECT_LT((extent.high - Vec3(4, 4, 3)).norm(), 1e-12);
}

}  // namespace
}  // namespace grainreel
