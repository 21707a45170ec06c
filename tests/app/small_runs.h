// A small run of each command that needs no window, and its document's fields.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tests/app/volume_input.h"

namespace stereonav::test {

class SmallRuns : public VolumeTest {
protected:
    using Words = std::vector<std::string>;
    // A small run of each command, and what it leaves to be read off its document.
    struct Small {
        Words words;
        Words fields;
    };
    // Hills near Krakow.
    std::string placedHills() const {
        const std::string file = input("placed.asc",
                                       "ncols 3\nnrows 3\nxllcorner 20\nyllcorner 50\ncellsize 0.001\n"
                                       "1 2 3\n4 5 6\n7 8 9\n");
        input("placed.prj",
              "GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\",6378137,298.257223563]],"
              "PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]]");
        return file;
    }
    std::map<std::string, Small> runs(const std::string& ground) const {
        return {{"info", {{ground, "--size", "16x12"}, {"scene", "terrain", "plan"}}},
                {"render",
                 {{ground, "--size", "16x12", "--out", "a.png"}, {"picture", "left_ms", "holes_percent"}}},
                {"play",
                 {{ground, "--size", "16x12", "--frames", "2", "--out", "frames"},
                  {"folder", "frames", "median_left_ms"}}},
                {"compare",
                 {{ground, "--size", "16x12", "--frames", "1", "--repeats", "1", "--methods", "paper"}, {}}},
                {"report",
                 {{"--quick", "--minutes", "0.01", "--parts", "stability", "--out", "page"},
                  {"page", "figures", "time_s"}}},
                {"mesh", {{ground, "--out", "a.glb"}, {"mesh", "triangles", "largest_error_m"}}},
                {"viewshed",
                 {{ground, "--from", "20,20", "--out", "shed.tif"}, {"viewshed", "seen_samples", "crs"}}},
                {"measure", {{ground, "--line", "20,20,60,60", "--csv", "line.csv"}, {"measures", "csv"}}},
                {"profile",
                 {{ground, "--line", "20,20,60,60", "--svg", "line.svg"}, {"points", "along_m", "svg"}}},
                {"sun", {{placedHills(), "--at", "2026-06-21"}, {"azimuth_deg", "next_sunset_utc"}}},
                {"centreline",
                 {{"colon", "--out", "line.txt"}, {"centreline", "points", "length_mm", "segments"}}},
                {"coverage",
                 {{maskedTube(), "--no-cache", "--out", "patches.csv"},
                  {"one_way_percent", "two_way_percent", "after_patches_percent", "patches", "table"}}},
                {"findings",
                 {{maskedTube(), "--no-cache", "--at", "0,7,0", "--csv", "findings.csv"},
                  {"findings", "crads", "notice", "table"}}},
                {"register",
                 {{maskedTube(), "--no-cache", "--with", maskedTube()}, {"length_mm", "other", "cost"}}},
                {"unfold",
                 {{maskedTube(), "--no-cache", "--out", "wall.png"},
                  {"picture", "size", "area_error_percent", "hidden_percent"}}},
                {"cache", {{}, {"folder", "files", "kept_bytes", "limit_bytes"}}},
                {"bake",
                 {{ground, "--what", "openness", "--resolution", "0.25", "--out", "a.light"},
                  {"light", "what", "baked_before", "samples"}}}};
    }
    Outcome runWith(const std::string& command, const Small& small, const Words& more) const {
        Words all{command};
        all.insert(all.end(), small.words.begin(), small.words.end());
        all.insert(all.end(), more.begin(), more.end());
        return run(all);
    }
};

}  // namespace stereonav::test
