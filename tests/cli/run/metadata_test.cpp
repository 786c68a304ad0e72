// Tests that every variable of every NetCDF file has a description and units that UDUNITS knows.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netcdf.h>

#include <array>
#include <filesystem>
#include <set>
#include <string>

#include "tests/cli/program.hpp"
#include "tests/support/small_scene.hpp"
#include "tests/support/temporary_folder.hpp"

namespace grainreel {
namespace {

using testing::HasSubstr;

// A scene with a feed, an outlet, a plane, two species, orientations, forces on walls and fields, so that all
// variables are written.
const std::string kEverything =
    test::SmallScene("title = \"Everything\"\n")
        .beads(6, "small")
        .beads(2, "big", "8 mm", "1200")
        .more("[contact]\nstiffness = 200\n")
        .box("30 mm", "20 mm", "60 mm")
        .more("top = \"open\"\n")
        .more("outlet = { width = \"14 mm\", opens = \"0.05 s\", exit_depth = \"15 mm\" }\n")
        .more("[[wall]]\nname = \"paddle\"\npoint = [0, 0.02, 0]\nnormal = [0, -1, 0]\n")
        .shaken("20 Hz", "2")
        .more("[[feed]]\nspecies = \"small\"\nrate = 200\n")
        .lasts("0.15 s")
        .more("[output]\ncontacts = true\norientation = true\ninstruments = [\"walls\"]\n")
        .more("[output.fields]\ngrid = \"yz\"\nperiods = 1\n[film]\nsize = \"160x120\"\n")
        .more("rate = 10\n")
        .text();

// These units were read by UDUNITS-2 when it was tried.
const std::set<std::string> known_units{"1",       "s", "second", "m",  "meter",  "degree", "m s-1",
                                        "rad s-1", "N", "Pa",     "m3", "kg m-3", "m2 s-2"};

std::string text_of(int file, int variable, const char* name) {
    std::size_t length = 0;
    if (nc_inq_attlen(file, variable, name, &length) != NC_NOERR) return "";
    std::string text(length, ' ');
    nc_get_att_text(file, variable, name, text.data());
    return text;
}

TEST(MetadataOfRuns, EveryVariableSaysWhatItIs) {
    const test::TemporaryFolder here;
    test::write_text(here / "all.toml", kEverything);
    const test::Ended ended =
        test::run_program({"movie", "all.toml", "--out", "run", "--threads", "1"}, {.folder = here.path()});
    ASSERT_EQ(ended.status, 0) << ended.err;
    for (const char* name : {"trajectory.nc", "film_moments.nc", "key_moments.nc", "contacts.nc",
                             "key_contacts.nc", "fields.nc"}) {
        int file = -1, count = 0;
        ASSERT_EQ(nc_open((here / "run" / name).c_str(), NC_NOWRITE, &file), NC_NOERR) << name;
        for (const char* attribute : {"title", "program", "programVersion", "gravity", "container", "drive",
                                      "seed", "frame_of_reference"})
            EXPECT_NE(text_of(file, NC_GLOBAL, attribute), "") << name << " " << attribute;
        EXPECT_EQ(text_of(file, NC_GLOBAL, "gravity"), "(0, 0, -9.81) m s-2");
        EXPECT_THAT(text_of(file, NC_GLOBAL, "drive"), HasSubstr("20 Hz"));
        EXPECT_THAT(text_of(file, NC_GLOBAL, "container"),
                    HasSubstr("box, 0.03 m wide (y), 0.02 m deep (x), 0.06 m high (z), open above"));
        EXPECT_THAT(text_of(file, NC_GLOBAL, "frame_of_reference"),
                    testing::StartsWith(std::string(name) == "fields.nc" ? "the container" : "the room"));
        nc_inq_nvars(file, &count);
        EXPECT_GT(count, 6);
        for (int variable = 0; variable < count; ++variable) {
            std::array<char, NC_MAX_NAME + 1> called{};
            nc_type type = NC_NAT;
            nc_inq_varname(file, variable, called.data());
            nc_inq_vartype(file, variable, &type);
            EXPECT_NE(text_of(file, variable, "long_name"), "") << name << " " << called.data();
            if (type == NC_CHAR) continue;  // names of axes
            EXPECT_EQ(known_units.count(text_of(file, variable, "units")), 1u)
                << name << " " << called.data() << ": " << text_of(file, variable, "units");
        }
        int found = -1;
        if (nc_inq_varid(file, "second", &found) == NC_NOERR) {
            EXPECT_THAT(text_of(file, found, "comment"), HasSubstr("-1 floor, -2 left_wall, -3 right_wall"));
            EXPECT_THAT(text_of(file, found, "comment"), HasSubstr("paddle"));
        }
        if (nc_inq_varid(file, "type", &found) == NC_NOERR) {
            EXPECT_EQ(text_of(file, found, "species"), "small\nbig");
            EXPECT_EQ(text_of(file, found, "density"), "2500 1200 kg m-3");
        }
        nc_close(file);
    }
}

}  // namespace
}  // namespace grainreel
