// Tests of fields in the page, read back in the form that page_fields.hpp describes.
#include "render/page/page_measures.hpp"

#include <gtest/gtest.h>
#include <libdeflate.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>

#include "engine/files/fields_file.hpp"
#include "render/scene/filmed_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

// A grid of 2 cells across and 3 in height, and, if it is in space, 2 in depth. All values of a cell follow
// from its number.
struct MadeFields {
    test::TemporaryFolder here;
    FilmedScene scene;
    FieldSet set;
    std::size_t deep;

    explicit MadeFields(bool in_space) : deep(in_space ? 2 : 1) {
        scene.species.resize(1);
        scene.species[0].name = "glass";
        scene.output.fields.grid = in_space ? FieldOutput::Grid::xyz : FieldOutput::Grid::yz;
        set.axes = {{"z", "m", "", {0.5, 1.5, 2.5}}, {"y", "m", "", {-0.25, 0.25}}};
        std::vector<std::string> axes{"z", "y"};
        if (in_space) set.axes.push_back({"x", "m", "", {-1, 1}}), axes.push_back("x");
        for (const char* name :
             {"free_volume", "density", "velocity_y", "velocity_z", "kinetic_stress_xx", "kinetic_stress_yy",
              "kinetic_stress_zz", "contact_stress_xx", "contact_stress_yy", "contact_stress_zz"})
            set.fields.push_back({name, name, "1", "", axes});
    }
    std::size_t cells() const { return 6 * deep; }
    // The page's fields, where value(field, record, cell) gives each value.
    PageFields page(const std::function<double(const std::string&, int, std::size_t)>& value) {
        FieldsWriter to(here / "fields.nc", {&set}, "made", "1");
        for (const int record : {0, 1}) {
            FieldValues values;
            for (const FieldInfo& field : set.fields) {
                values.emplace_back();
                for (std::size_t cell = 0; cell < cells(); ++cell)
                    values.back().push_back(value(field.name, record, cell));
            }
            to.write(record, record + 1, {values});
        }
        return page_fields(scene, here.path());
    }
};

const FieldQuantity& quantity(const PageFields& page, const std::string& name) {
    const auto found = std::find_if(page.quantities.begin(), page.quantities.end(),
                                    [&](const FieldQuantity& one) { return one.name == name; });
    if (found == page.quantities.end()) throw std::out_of_range(name);
    return *found;
}

// The value of a quantity in a record and a cell of the plane; NaN if there is none.
double on_page(const PageFields& page, const std::string& name, std::size_t record, std::size_t cell) {
    const std::size_t cells = page.y.count * page.z.count, kinds = page.quantities.size();
    std::vector<std::uint8_t> bytes(cells * (1 + kinds * page.records.size()));
    const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> unpacker(
        libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
    EXPECT_EQ(libdeflate_zlib_decompress(unpacker.get(), page.packed.data(), page.packed.size(), bytes.data(),
                                         bytes.size(), nullptr),
              LIBDEFLATE_SUCCESS);
    const FieldQuantity& of = quantity(page, name);
    const auto kind = static_cast<std::size_t>(&of - page.quantities.data());
    const int byte = bytes[cells * (1 + record * kinds + kind) + cell];
    return byte == 255 ? std::nan("") : of.low + (of.high - of.low) * byte / 254;
}

TEST(PageFields, SpeedAndPressureFollowFromTheFields) {
    MadeFields made(false);
    const PageFields page = made.page([](const std::string& name, int record, std::size_t cell) {
        const auto c = static_cast<double>(cell);
        if (name == "velocity_y") return 3 * c - 4;
        if (name == "velocity_z") return 4.0;
        if (name == "kinetic_stress_xx") return c;
        if (name == "contact_stress_zz") return 8.0;
        if (name == "density") return cell == 2 ? std::nan("") : 10 + c + 20 * record;
        return 0.0;
    });
    ASSERT_TRUE(page.present());
    EXPECT_NEAR(page.y.low, -0.5, 1e-12);
    EXPECT_NEAR(page.y.cell, 0.5, 1e-12);
    EXPECT_NEAR(page.z.low, 0, 1e-12);
    ASSERT_EQ(page.records.size(), 2u);
    EXPECT_EQ(page.records[1].begin, 1);
    for (std::size_t cell = 0; cell < 6; ++cell) {
        const auto c = static_cast<double>(cell);
        EXPECT_NEAR(on_page(page, "speed", 0, cell), std::hypot(3 * c - 4, 4.0), 0.05) << cell;
        EXPECT_NEAR(on_page(page, "pressure", 1, cell), (c + 8) / 3, 0.01) << cell;
        EXPECT_NEAR(on_page(page, "velocity_y", 1, cell), 3 * c - 4, 0.05) << cell;
    }
    EXPECT_EQ(quantity(page, "density").low, 10) << "of all records";
    EXPECT_EQ(quantity(page, "density").high, 35);
    EXPECT_NEAR(on_page(page, "density", 0, 5), 15, 0.06);
    EXPECT_NEAR(on_page(page, "density", 1, 0), 30, 0.06);
    EXPECT_TRUE(std::isnan(on_page(page, "density", 0, 2)));
}

// The first of two cells that lie behind each other has three times as much free room.
TEST(PageFields, InSpaceTheyAreMeansOverTheFreeVolume) {
    MadeFields made(true);
    const PageFields page = made.page([](const std::string& name, int, std::size_t cell) {
        if (name == "free_volume") return cell % 2 == 0 ? 3.0 : 1.0;
        return name == "density" ? static_cast<double>(cell / 2) + (cell % 2 == 0 ? 0 : 4) : 0.0;
    });
    ASSERT_TRUE(page.present());
    for (std::size_t cell = 0; cell < 6; ++cell)
        EXPECT_NEAR(on_page(page, "density", 0, cell), static_cast<double>(cell) + 1, 0.02) << cell;
}

TEST(PageFields, WhatIsNoFieldsFileIsSaid) {
    MadeFields made(false);
    EXPECT_FALSE(page_fields(made.scene, made.here.path()).present());
    test::write_text(made.here / "fields.nc", "no NetCDF");
    EXPECT_NE(page_fields(made.scene, made.here.path()).why_not, "");
}

}  // namespace
}  // namespace grainreel
