// Tracks of several segments, and segments that lead nowhere.
#include "raster_files.h"
#include "terrain/read/raster_file.h"

namespace stereonav::test {
namespace {

using Places = std::vector<glm::dvec2>;

std::string gpx(const std::string& inner) {
    return R"(<?xml version="1.0"?><gpx version="1.1" creator="t" xmlns="http://www.topografix.com/GPX/1/1">)" +
           inner + "</gpx>";
}

std::string segment(const Places& places) {
    std::string text = "<trkseg>";
    for (const glm::dvec2& place : places)
        text += "<trkpt lat=\"" + std::to_string(place.y) + "\" lon=\"" + std::to_string(place.x) + "\"/>";
    return text + "</trkseg>";
}

std::string track(const std::string& segments, const std::string& name = "walk") {
    return "<trk><name>" + name + "</name>" + segments + "</trk>";
}

const Places kFirst{{11, 47}, {11.5, 47.25}, {12, 47.5}}, kSecond{{12.5, 48}, {13, 48.25}};

void expectOneTrack(const std::string& of, const std::filesystem::path& file, const Places& places) {
    SCOPED_TRACE(of);
    const std::vector<TrackLine> tracks = readTracks(file);
    ASSERT_EQ(tracks.size(), 1u);
    ASSERT_EQ(tracks[0].degrees.size(), places.size());
    for (std::size_t n = 0; n < places.size(); ++n) EXPECT_EQ(tracks[0].degrees[n], places[n]) << n;
}

TEST(TrackFile, SegmentsOfATrackAreOneTrack) {
    const TempFolder folder;
    Places both = kFirst;
    both.insert(both.end(), kSecond.begin(), kSecond.end());
    const auto of = [&](const std::string& inner) { return folder.text("t.gpx", gpx(inner)); };
    const std::string one = segment(kFirst), other = segment(kSecond), none = segment({}),
                      point = segment({{9, 9}}), still = segment({{8, 8}, {8, 8}, {8, 8}});
    expectOneTrack("one", of(track(one)), kFirst);
    expectOneTrack("two", of(track(one + other)), both);
    expectOneTrack("empty ones", of(track(none + one + none + other + none)), both);
    expectOneTrack("single points", of(track(point + one + other + point)), both);
    expectOneTrack("a stop", of(track(one + still + other)), both);
    expectOneTrack("an empty track", of(track(none, "a") + track(one + other, "b") + track("", "c")), both);
    expectOneTrack("a track of one point", of(track(point, "a") + track(one + other, "b")), both);
    const auto json = [&](const std::string& lines) {
        return folder.text(
            "t.geojson",
            R"({"type":"Feature","properties":{},"geometry":{"type":"MultiLineString","coordinates":)" +
                lines + "}}");
    };
    expectOneTrack("GeoJSON", json("[[[11,47],[11.5,47.25],[12,47.5]],[[12.5,48],[13,48.25]]]"), both);
    expectOneTrack("GeoJSON, single points", json("[[[1,1]],[[11,47],[11.5,47.25],[12,47.5]],[]]"), kFirst);
}

TEST(TrackFile, TracksStayApart) {
    const TempFolder folder;
    const auto file = folder.text("t.gpx", gpx(track(segment(kFirst), "a") + track(segment(kSecond), "b")));
    const std::vector<TrackLine> tracks = readTracks(file);
    ASSERT_EQ(tracks.size(), 2u);
    EXPECT_EQ(tracks[0].name, "a");
    EXPECT_EQ(tracks[1].degrees.size(), kSecond.size());
    // Segments are drawn each by itself: nobody walked in between.
    EXPECT_EQ(
        readTrackFile(folder.text("s.gpx", gpx(track(segment(kFirst) + segment(kSecond))))).lines.size(), 2u);
    const auto areas = folder.text(
        "a.geojson",
        R"({"type":"MultiPolygon","coordinates":[[[[0,0],[1,0],[1,1],[0,0]]],[[[5,5],[6,5],[6,6],[5,5]]]]})");
    EXPECT_EQ(readTracks(areas).size(), 2u);
}

}  // namespace
}  // namespace stereonav::test
