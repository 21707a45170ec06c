#include "colon/study/dcmtk/report_content.h"

#include <dcmtk/dcmsr/cmr/tid1500.h>
#include <dcmtk/dcmsr/codes/dcm.h>
#include <fmt/format.h>

#include <cmath>
#include <span>
#include <string_view>

#include "engine/base/error.h"

namespace stereonav {
namespace {

using Codes = CID7469_GenericIntensityAndSizeMeasurements;
using Units = CID7181_AbstractMultiDimensionalImageModelComponentUnits;
using Derivations = CID7464_GeneralRegionOfInterestMeasurementModifiers;
using Group = TID1500_MeasurementReport::TID1501_Measurements;

constexpr const char *kOwnScheme = "99STEREONAV", *kPlaceCode = "PLACE-LPS";

// Codes of SNOMED CT that DCMTK has no names for.
DSRCodedEntryValue snomed(const char* code, const char* meaning) {
    return {code, "SCT", meaning};
}

DSRCodedEntryValue siteOf(std::string_view segment) {
    struct Site {
        std::string_view segment;
        const char *code, *meaning;
    };
    constexpr Site kSites[] = {{"rectum", "34402009", "Rectum"},
                               {"sigmoid", "60184004", "Sigmoid colon"},
                               {"descending", "32622004", "Descending colon"},
                               {"splenic flexure", "72592005", "Splenic flexure of colon"},
                               {"transverse", "485005", "Transverse colon"},
                               {"hepatic flexure", "48338005", "Hepatic flexure of colon"},
                               {"ascending", "9040008", "Ascending colon"},
                               {"caecum", "32713005", "Cecum"}};
    for (const Site& site : kSites)
        if (site.segment == segment) return snomed(site.code, site.meaning);
    return snomed("71854001", "Colon");
}

DSRCodedEntryValue cradsOf(int crads) {
    switch (crads) {
        case 1:
            return CODE_DCM_C1_NormalColonOrBenignLesion;
        case 2:
            return CODE_DCM_C2_IntermediatePolypOrIndeterminateFinding;
        case 3:
            return CODE_DCM_C3_Polyp_PossiblyAdvancedAdenoma;
        default:
            return CODE_DCM_C4_ColonicMass_LikelyMalignant;
    }
}

std::string placeWords(const MmPlace& p) {
    return fmt::format("{:.2f}, {:.2f}, {:.2f} mm to the left, back and head", p[0], p[1], p[2]);
}

// Returns false where there is no finite number to say.
bool addNumber(Group& group, const DSRCodedEntryValue& name, const std::optional<double>& value,
               Units::EnumType unit) {
    if (!value || !std::isfinite(*value)) return false;
    const std::string text = fmt::format("{:.2f}", *value);
    check(group.addMeasurement(Codes(name), Group::MeasurementValue(text.c_str(), Units(unit))), "a figure");
    return true;
}

void addHu(Group& group, const std::optional<double>& value, Derivations::EnumType derivation) {
    if (addNumber(group, CODE_DCM_AttenuationCoefficient, value, Units::HounsfieldUnit))
        check(group.getMeasurement().setDerivation(Derivations(derivation)), "how a figure was derived");
}

void addFinding(const ReportedFinding& finding, TID1500_MeasurementReport& tree) {
    check(tree.addIndividualMeasurements(), "a finding");
    Group& group = tree.getIndividualMeasurements();
    check(group.setTrackingIdentifier(finding.label.c_str()), "a finding's name");
    check(group.setTrackingUniqueIdentifier(finding.uid.c_str()), "a finding's UID");
    if (finding.polyp) check(group.setFinding(snomed("68496003", "Polyp of colon")), "what a finding is");
    check(group.addFindingSite(siteOf(finding.segment)), "a finding's segment");
    addNumber(group, Codes::getCodedEntry(Codes::Maximum3DDiameterOfAMesh), finding.longest_mm,
              Units::Millimeter);
    addNumber(group, Codes::getCodedEntry(Codes::LongAxis), finding.inSlice_mm, Units::Millimeter);
    addNumber(group, snomed("118565006", "Volume"), finding.volume_mm3, Units::CubicMillimeter);
    addHu(group, finding.huMean, Derivations::Mean);
    addHu(group, finding.huSigma, Derivations::StandardDeviation);
    addNumber(group, CODE_DCM_DistanceFromAnus, finding.fromRectum_mm, Units::Millimeter);
    const DSRCodedEntryValue place(kPlaceCode, kOwnScheme, "Place in the patient's axes");
    check(group.addQualitativeEvaluation(place, OFString(placeWords(finding.place_mm).c_str())),
          "a finding's place");
    if (!finding.note.empty())
        check(group.addQualitativeEvaluation(CODE_DCM_Comment, OFString(finding.note.c_str())), "a note");
}

void addCoordinates(DSRDocumentTree& tree, DSRTypes::E_RelationshipType relation,
                    const DSRCodedEntryValue& name, DSRTypes::E_GraphicType3D type,
                    std::span<const MmPlace> places, const std::string& frame) {
    DSRSpatialCoordinates3DValue value(type);
    for (const MmPlace& p : places)
        value.getGraphicDataList().addItem(static_cast<Float32>(p[0]), static_cast<Float32>(p[1]),
                                           static_cast<Float32>(p[2]));
    check(value.setFrameOfReferenceUID(frame.c_str()), "the frame of reference");
    if (tree.addContentItem(relation, DSRTypes::VT_SCoord3D, DSRTypes::AM_belowCurrent) == 0)
        throw Error("", "structured report", "the module can not store a place in it", "leave --sr out");
    check(tree.getCurrentContentItem().setConceptName(name), "a place's name");
    check(tree.getCurrentContentItem().setSpatialCoordinates3D(value), "a place's coordinates");
    tree.goUp();
}

// Where findings are in the study's frame of reference, and between which places they are longest.
void addPlaces(const StructuredReport& report, DSRDocumentTree& tree) {
    std::size_t node = tree.gotoNamedNode(CODE_DCM_MeasurementGroup);
    for (const ReportedFinding& finding : report.findings) {
        if (node == 0)
            throw Error("", "structured report", "the module can not store a finding in it",
                        "leave --sr out");
        const std::size_t group = tree.getNodeID();
        addCoordinates(tree, DSRTypes::RT_contains, CODE_DCM_Center, DSRTypes::GT3_Point,
                       std::span(&finding.place_mm, 1), report.source->frame);
        if (finding.longestEnds_mm && finding.longest_mm && std::isfinite(*finding.longest_mm) &&
            tree.gotoNamedChildNode(Codes::getCodedEntry(Codes::Maximum3DDiameterOfAMesh)) != 0)
            addCoordinates(tree, DSRTypes::RT_inferredFrom, CODE_DCM_Path, DSRTypes::GT3_Polyline,
                           *finding.longestEnds_mm, report.source->frame);
        tree.gotoNode(group);
        node = tree.gotoNextNamedNode(CODE_DCM_MeasurementGroup, OFFalse);
    }
}

}  // namespace

void check(const OFCondition& done, const char* what) {
    if (done.good()) return;
    throw Error("", "structured report", fmt::format("{} can not be stored in it: {}", what, done.text()),
                "leave --sr out, or mend what it names");
}

void addContent(const StructuredReport& report, DSRDocument& document) {
    TID1500_MeasurementReport tree(CID7021_MeasurementReportDocumentTitles::ImagingMeasurementReport);
    check(tree.setLanguage(CID5000_Languages::English), "the language");
    check(tree.getObservationContext().addDeviceObserver(report.device.c_str(), "stereonav", "stereonav",
                                                         report.software.c_str()),
          "the program");
    check(tree.addProcedureReported(CID100_QuantitativeDiagnosticImagingProcedures::CTUnspecifiedBodyRegion),
          "the procedure");
    for (const ReportedFinding& finding : report.findings) addFinding(finding, tree);
    check(tree.addQualitativeEvaluation(CODE_DCM_ColonOverallAssessment, cradsOf(report.crads)),
          "the C-RADS class");
    check(tree.addQualitativeEvaluation(CODE_DCM_Comment, OFString(report.notice.c_str())), "the notice");
    check(document.setTreeFromRootTemplate(tree), "the content");
    check(document.changeDocumentType(DSRTypes::DT_Comprehensive3DSR),
          "places in space");  // the template's is plainer
    check(document.getCodingSchemeIdentification().addItem(kOwnScheme), "the coding scheme");
    check(document.getCodingSchemeIdentification().setCodingSchemeName("Codes of stereonav"),
          "the coding scheme");
    if (report.source && !report.source->frame.empty()) addPlaces(report, document.getTree());
}

}  // namespace stereonav
