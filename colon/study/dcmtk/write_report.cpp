// Structured reports, through DCMTK.
#include <dcmtk/dcmdata/dcdeftag.h>
#include <dcmtk/dcmdata/dcfilefo.h>
#include <dcmtk/dcmdata/dcostrmb.h>
#include <dcmtk/dcmdata/dcspchrs.h>
#include <dcmtk/oflog/oflog.h>

#include <algorithm>
#include <array>

#include "colon/study/dcmtk/report_content.h"
#include "colon/study/structured_report_module.h"
#include "engine/base/error.h"
#include "engine/base/module.h"

namespace stereonav {
namespace {

constexpr const char* kUtf8 = "ISO_IR 192";

// Turns the study's characters into those of the report. What its own character set does not explain becomes
// question marks: broken headers are common, and a report should not fail over one.
class Characters {
public:
    explicit Characters(const std::string& from)
        : mReadable(mSet.selectCharacterSet(from.c_str(), kUtf8).good()) {}

    OFString operator()(const std::string& text) {
        OFString converted;
        if (mReadable && mSet.convertString(text.c_str(), converted, "\\^=").good()) return converted;
        std::string plain = text;
        std::replace_if(
            plain.begin(), plain.end(), [](char c) { return static_cast<signed char>(c) < 0x20; }, '?');
        return plain.c_str();
    }

private:
    DcmSpecificCharacterSet mSet;
    bool mReadable;
};

// Adds attributes of the patient and the study, which are the same in all documents of a study. Damaged ones
// are copied as they are.
void addSource(const StudySource& source, DSRDocument& document) {
    Characters text(source.characters);
    check(document.setPatientName(text(source.patientName), OFFalse), "the patient's name");
    check(document.setPatientID(text(source.patientId), OFFalse), "the patient's ID");
    check(document.setPatientBirthDate(source.birthDate.c_str(), OFFalse), "the patient's birth date");
    check(document.setPatientSex(source.sex.c_str(), OFFalse), "the patient's sex");
    check(document.setStudyDate(source.studyDate.c_str(), OFFalse), "the study's date");
    check(document.setStudyTime(source.studyTime.c_str(), OFFalse), "the study's time");
    check(document.setStudyID(text(source.studyId), OFFalse), "the study's ID");
    check(document.setAccessionNumber(text(source.accession), OFFalse), "the accession number");
    check(document.setReferringPhysicianName(text(source.referring), OFFalse), "the physician's name");
    check(document.setStudyDescription(text(source.studyDescription), OFFalse), "the study's description");
    if (source.study.empty() || source.series.empty()) return;
    for (const auto& [kind, picture] : source.pictures)
        check(document.getCurrentRequestedProcedureEvidence().addItem(
                  source.study.c_str(), source.series.c_str(), kind.c_str(), picture.c_str()),
              "a picture that was measured");
}

void addAttributes(const StructuredReport& report, DSRDocument& document) {
    const bool inStudy = report.source && !report.source->study.empty();
    const std::string& study = inStudy ? report.source->study : report.study;
    check(document.createNewSeriesInStudy(study.c_str()), "the study's UID");
    check(document.setSpecificCharacterSetType(DSRTypes::CS_UTF8), "the character set");
    if (report.source)
        addSource(*report.source, document);
    else
        check(document.setPatientName("unknown"), "the patient's name");
    check(document.setSeriesDescription("Findings, not for diagnosis"), "the series' description");
    check(document.setSeriesNumber("9001"), "the series' number");
    check(document.setInstanceNumber("1"), "the number");
    check(document.setManufacturer("stereonav"), "the maker");
    check(document.setManufacturerModelName("stereonav"), "the maker");
    check(document.setSoftwareVersions(report.software.c_str()), "the version");
    for (const auto set : {&DSRDocument::setContentDate, &DSRDocument::setSeriesDate})
        check((document.*set)(report.date.c_str(), OFTrue), "the date");
    for (const auto set : {&DSRDocument::setContentTime, &DSRDocument::setSeriesTime})
        check((document.*set)(report.time.c_str(), OFTrue), "the time");
    check(document.setPreliminaryFlag(DSRTypes::PF_Preliminary), "that it is preliminary");
}

void put(DcmDataset& set, const DcmTagKey& tag, const std::string& value) {
    check(set.putAndInsertString(tag, value.c_str()), "a UID");
}

std::string bytesOf(DcmFileFormat& file) {
    constexpr E_TransferSyntax kSyntax = EXS_LittleEndianExplicit;
    check(file.validateMetaInfo(kSyntax), "the head");
    std::string bytes;
    std::array<char, 1 << 16> block;
    DcmOutputBufferStream stream(block.data(), block.size());
    const auto take = [&] {
        void* data = nullptr;
        offile_off_t count = 0;
        stream.flushBuffer(data, count);
        bytes.append(static_cast<const char*>(data), static_cast<std::size_t>(count));
    };
    file.transferInit();
    OFCondition done;
    do {
        done = file.write(stream, kSyntax, EET_ExplicitLength, nullptr);
        take();
    } while (done == EC_StreamNotifyClient);
    file.transferEnd();
    check(done, "all of it");
    return bytes;
}

}  // namespace

std::string structuredReportFile(const StructuredReport& report) {
    OFLog::configure(OFLogger::OFF_LOG_LEVEL);  // failures are reported as exceptions
    DSRDocument document;
    addAttributes(report, document);
    addContent(report, document);
    DcmFileFormat file;
    DcmDataset& set = *file.getDataset();
    check(document.write(set), "it");
    if (!set.containsExtendedCharacters(OFTrue)) set.findAndDeleteElement(DCM_SpecificCharacterSet);
    put(set, DCM_SeriesInstanceUID, report.series);
    put(set, DCM_SOPInstanceUID, report.document);
    put(set, DCM_InstanceCreationDate, report.date);
    put(set, DCM_InstanceCreationTime, report.time);
    return bytesOf(file);
}

namespace {
constexpr StructuredReportFunctions kFunctions = {structuredReportFile};
}

const ModuleEntry stereonavModule = moduleEntry(kFunctions);

}  // namespace stereonav
