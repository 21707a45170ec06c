// Structured reports: read back by DCMTK, figures, places and whose study it is.
#include "colon/study/structured_report.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcdeftag.h>
#include <dcmtk/dcmdata/dcfilefo.h>
#include <dcmtk/dcmdata/dcistrmb.h>
#include <dcmtk/dcmsr/cmr/cid7469.h>
#include <dcmtk/dcmsr/codes/dcm.h>
#include <dcmtk/dcmsr/dsrdoc.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "../camera/temporary_folder.h"
#include "colon/instruments/findings_report.h"
#include "colon/study/dicom_uid.h"
#include "tests/colon/study_dicom_slices.h"

namespace stereonav::test {
namespace {
namespace fs = std::filesystem;

// Writes a study of three slices, made one of a patient in one frame of reference.
void writeNamedStudy(const fs::path& folder, const char* lastFrame = "1.2.3.4") {
    writeStudy(folder);
    for (int k = 0; k < kSlices; ++k) {
        const std::string name = (folder / fmt::format("s{}.dcm", k)).string();
        DcmFileFormat file;
        ASSERT_TRUE(file.loadFile(name.c_str()).good());
        DcmDataset& set = *file.getDataset();
        const std::pair<DcmTagKey, const char*> texts[] = {
            {DCM_SpecificCharacterSet, "ISO_IR 100"},
            {DCM_PatientName, "M\xfcller^Eva"},
            {DCM_PatientID, "P7"},
            {DCM_PatientSex, "F"},
            {DCM_StudyInstanceUID, "1.2.3.9"},
            {DCM_StudyDate, "20200131"},
            {DCM_FrameOfReferenceUID, k == kSlices - 1 ? lastFrame : "1.2.3.4"},
            {DCM_SOPInstanceUID, k == 0   ? "1.2.5.1"
                                 : k == 1 ? "1.2.5.2"
                                          : "1.2.5.3"}};
        for (const auto& [tag, text] : texts) ASSERT_TRUE(set.putAndInsertString(tag, text).good());
        ASSERT_TRUE(file.saveFile(name.c_str(), EXS_LittleEndianExplicit).good());
    }
}

std::vector<Finding> twoFindings() {
    Finding polyp;
    polyp.comment = "on a fold, \xc3\xa4";
    polyp.polyp.emplace();
    polyp.polyp->middle = {0.0125, -0.04, 0.31};
    polyp.polyp->widest = {0.0104, {0.01, -0.04, 0.31}, {0.0204, -0.04, 0.31}};
    polyp.polyp->widestInSlice.length = 0.0091;
    polyp.polyp->volume = 2.5e-7;
    polyp.values = PolypValues{41.25, 14.5, 60};
    polyp.along = 0.2;
    polyp.segment = "sigmoid";
    Finding none;
    none.asked = {0.1, 0.2, 0.3};
    none.problem = "nothing bulges there";
    none.along = 0.7;
    Finding doubled = polyp;
    doubled.doubled = true;
    return {polyp, doubled, none};
}

class ReadReport {
public:
    explicit ReadReport(const StructuredReport& report) : mBytes(structuredReportFile(report)) {
        DcmInputBufferStream stream;
        stream.setBuffer(mBytes.data(), static_cast<offile_off_t>(mBytes.size()));
        stream.setEos();
        mFile.transferInit();
        EXPECT_TRUE(mFile.read(stream).good());
        mFile.transferEnd();
        const OFCondition read = document.read(set());
        EXPECT_TRUE(read.good()) << read.text();
        EXPECT_TRUE(document.isValid());
    }

    DcmDataset& set() { return *mFile.getDataset(); }
    std::string text(const DcmTagKey& tag) {
        OFString value;
        set().findAndGetOFString(tag, value);
        return value.c_str();
    }
    // Goes to the item of that name in a measurement group, from 0 on; false where there is none.
    bool go(int group, const DSRCodedEntryValue& name, int which = 0) {
        DSRDocumentTree& tree = document.getTree();
        std::size_t node = tree.gotoNamedNode(CODE_DCM_MeasurementGroup);
        for (int n = 0; n < group && node != 0; ++n)
            node = tree.gotoNextNamedNode(CODE_DCM_MeasurementGroup, OFFalse);
        if (node != 0) node = tree.gotoNamedChildNode(name);
        for (int n = 0; n < which && node != 0; ++n) node = tree.gotoNextNamedNode(name, OFFalse);
        return node != 0;
    }
    const DSRContentItem& item() { return document.getTree().getCurrentContentItem(); }
    std::string number(int group, const DSRCodedEntryValue& name, int which = 0) {
        if (!go(group, name, which)) return "";
        const DSRNumericMeasurementValue& value = item().getNumericValue();
        return std::string(value.getNumericValue().c_str()) + " " +
               value.getMeasurementUnit().getCodeValue().c_str();
    }

    DSRDocument document;

private:
    std::string mBytes;
    DcmFileFormat mFile;
};

using Sizes = CID7469_GenericIntensityAndSizeMeasurements;

TEST(StructuredReport, HasTheFiguresOfFindings) {
    const TemporaryFolder folder;
    writeNamedStudy(folder / "slices");
    const auto source = sourceOf(folder / "slices", {});
    ASSERT_TRUE(source);
    ReadReport read(reportOf("a", source, twoFindings(), "stereonav 1", 1000000));
    EXPECT_EQ(read.document.getDocumentType(), DSRTypes::DT_Comprehensive3DSR);
    EXPECT_EQ(read.number(0, Sizes::getCodedEntry(Sizes::Maximum3DDiameterOfAMesh)), "10.40 mm");
    EXPECT_EQ(read.number(0, Sizes::getCodedEntry(Sizes::LongAxis)), "9.10 mm");
    EXPECT_EQ(read.number(0, {"118565006", "SCT", "Volume"}), "250.00 mm3");
    EXPECT_EQ(read.number(0, CODE_DCM_AttenuationCoefficient), "41.25 [hnsf'U]");
    EXPECT_EQ(read.number(0, CODE_DCM_AttenuationCoefficient, 1), "14.50 [hnsf'U]");
    EXPECT_EQ(read.number(0, CODE_DCM_DistanceFromAnus), "200.00 mm");
    ASSERT_TRUE(read.go(0, CODE_DCM_Center));
    const DSRSpatialCoordinates3DValue place = read.item().getSpatialCoordinates3D();
    EXPECT_STREQ(place.getFrameOfReferenceUID().c_str(), "1.2.3.4");
    DSRSpatialCoordinates3DValue copy = place;
    EXPECT_NEAR(copy.getGraphicDataList().getItem(1).XCoord, 12.5, 1e-4);
    EXPECT_NEAR(copy.getGraphicDataList().getItem(1).YCoord, -40, 1e-4);
    EXPECT_NEAR(copy.getGraphicDataList().getItem(1).ZCoord, 310, 1e-4);
    ASSERT_TRUE(read.go(0, Sizes::getCodedEntry(Sizes::Maximum3DDiameterOfAMesh)));
    ASSERT_NE(read.document.getTree().gotoNamedChildNode(CODE_DCM_Path), 0u) << "between which places";
    ASSERT_TRUE(read.go(0, CODE_DCM_Comment));
    EXPECT_EQ(std::string(read.item().getStringValue().c_str()).find("on a fold, \xc3\xa4"), 0u);
    // The second is of the same polyp and left out; the third has no polyp.
    ASSERT_TRUE(read.go(1, CODE_DCM_DistanceFromAnus));
    EXPECT_EQ(read.number(1, CODE_DCM_DistanceFromAnus), "700.00 mm");
    EXPECT_FALSE(read.go(1, {"121071", "DCM", "Finding"}));
    EXPECT_TRUE(read.go(0, {"121071", "DCM", "Finding"}));
    EXPECT_FALSE(read.go(2, CODE_DCM_DistanceFromAnus));
    EXPECT_NE(read.document.getTree().gotoNamedNode(CODE_DCM_ColonOverallAssessment), 0u);
    EXPECT_STREQ(read.item().getCodeValue().getCodeValue().c_str(), "112243") << "C3: one of 10 mm and more";
}

TEST(StructuredReport, IsOfTheSamePatientAndStudy) {
    const TemporaryFolder folder;
    writeNamedStudy(folder / "slices");
    const auto source = sourceOf(folder / "slices", {});
    ASSERT_TRUE(source);
    const StructuredReport report = reportOf("a", source, twoFindings(), "stereonav 1", 1000000);
    ReadReport read(report);
    EXPECT_EQ(read.text(DCM_SpecificCharacterSet), "ISO_IR 192");
    EXPECT_EQ(read.text(DCM_PatientName), "M\xc3\xbcller^Eva");
    EXPECT_EQ(read.text(DCM_PatientID), "P7");
    EXPECT_EQ(read.text(DCM_PatientSex), "F");
    EXPECT_EQ(read.text(DCM_StudyInstanceUID), "1.2.3.9");
    EXPECT_EQ(read.text(DCM_StudyDate), "20200131");
    EXPECT_EQ(read.text(DCM_SOPInstanceUID), report.document);
    EXPECT_EQ(read.text(DCM_SeriesInstanceUID), report.series);
    EXPECT_EQ(read.document.getCurrentRequestedProcedureEvidence().getNumberOfInstances(), 3u);
}

// Coordinates are told in words where slices are of several frames of reference, or of none.
TEST(StructuredReport, SaysPlacesInWordsWithoutAFrame) {
    const TemporaryFolder folder;
    writeNamedStudy(folder / "slices", "1.2.3.5");
    const auto source = sourceOf(folder / "slices", {});
    ASSERT_TRUE(source);
    EXPECT_EQ(source->frame, "");
    for (const std::optional<StudySource>& of : {source, std::optional<StudySource>()}) {
        ReadReport read(reportOf("a", of, twoFindings(), "stereonav 1", 1000000));
        EXPECT_FALSE(read.go(0, CODE_DCM_Center));
        ASSERT_TRUE(read.go(0, {"PLACE-LPS", "99STEREONAV", "Place in the patient's axes"}));
        EXPECT_EQ(std::string(read.item().getStringValue().c_str()).find("12.50, -40.00, 310.00 mm"), 0u);
    }
    ReadReport unknown(reportOf("a", std::nullopt, {}, "stereonav 1", 1000000));
    EXPECT_EQ(unknown.text(DCM_PatientName), "unknown");
    EXPECT_EQ(unknown.text(DCM_SpecificCharacterSet), "") << "all of it is ASCII";
    EXPECT_EQ(unknown.text(DCM_StudyInstanceUID), uidOfText("study a"));
    EXPECT_FALSE(sourceOf(fs::path(STEREONAV_SOURCE_DIR) / "README.md", {}));
}

TEST(StructuredReport, LeavesOutWhatIsNoNumber) {
    StructuredReport report = reportOf("a", std::nullopt, twoFindings(), "stereonav 1", 1000000);
    report.findings[0].longest_mm = std::numeric_limits<double>::quiet_NaN();
    report.findings[0].volume_mm3 = std::numeric_limits<double>::infinity();
    ReadReport read(report);
    EXPECT_EQ(read.number(0, Sizes::getCodedEntry(Sizes::Maximum3DDiameterOfAMesh)), "");
    EXPECT_EQ(read.number(0, {"118565006", "SCT", "Volume"}), "");
    EXPECT_EQ(read.number(0, Sizes::getCodedEntry(Sizes::LongAxis)), "9.10 mm");
}

// A head that no character set explains is no reason to fail.
TEST(StructuredReport, TakesDamagedNames) {
    StudySource source;
    source.characters = "ISO_IR 9999";
    source.patientName = "M\xfcller";
    ReadReport read(reportOf("a", source, {}, "stereonav 1", 1000000));
    EXPECT_EQ(read.text(DCM_PatientName), "M?ller");
    EXPECT_EQ(read.text(DCM_StudyInstanceUID), uidOfText("study a"));
}

TEST(StructuredReport, UidsAreOfWhatTheyName) {
    const auto at = [](std::time_t now, std::vector<Finding> findings) {
        return reportOf("a", std::nullopt, findings, "stereonav 1", now);
    };
    const StructuredReport one = at(1000000, twoFindings()), same = at(1000000, twoFindings()),
                           later = at(1000001, twoFindings());
    EXPECT_EQ(structuredReportFile(one), structuredReportFile(same));
    EXPECT_NE(one.document, later.document);
    EXPECT_EQ(one.findings[0].uid, later.findings[0].uid);
    EXPECT_NE(one.findings[0].uid, one.findings[1].uid);
    EXPECT_NE(one.document, one.series);
    for (const std::string& uid : {one.document, uidOfText(""), uidOfText("a")}) {
        EXPECT_EQ(uid.find("2.25."), 0u);
        EXPECT_LE(uid.size(), 44u);
        EXPECT_EQ(uid.find_first_not_of("0123456789."), std::string::npos);
    }
}

}  // namespace
}  // namespace stereonav::test
