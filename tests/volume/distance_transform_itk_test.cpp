// The distance transform against ITK's Maurer filter, where ITK is there.
#include <gtest/gtest.h>

#include "engine/volume/distance_transform.h"
#include "test_volumes.h"

#if STEREONAV_COMPARE_ITK
#include <itkImage.h>
#include <itkMultiThreaderBase.h>
#include <itkSignedMaurerDistanceMapImageFilter.h>
#endif

namespace stereonav {
namespace {

#if STEREONAV_COMPARE_ITK
// ITK's distances in metres. Its object is what is not in the mask, and it measures to the object's voxels
// that have a neighbour outside it, where the nearest always is.
itk::Image<double, 3>::Pointer maurer(const MaskVolume& mask) {
    // In this thread alone: ITK is not built for the thread sanitizer.
    itk::MultiThreaderBase::SetGlobalDefaultThreader(itk::MultiThreaderBaseEnums::Threader::Platform);
    itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(1);
    using Object = itk::Image<unsigned char, 3>;
    const auto image = Object::New();
    Object::SizeType size;
    Object::SpacingType spacing;
    for (unsigned a = 0; a < 3; ++a) {
        size[a] = static_cast<unsigned>(mask.frame.size[static_cast<int>(a)]);
        spacing[a] = mask.frame.spacing[static_cast<int>(a)];
    }
    image->SetRegions(size);
    image->SetSpacing(spacing);
    image->Allocate();
    for (std::size_t n = 0; n < mask.values.size(); ++n)
        image->GetBufferPointer()[n] = mask.values[n] ? 0 : 1;
    const auto filter = itk::SignedMaurerDistanceMapImageFilter<Object, itk::Image<double, 3>>::New();
    filter->SetInput(image);
    filter->SquaredDistanceOff();
    filter->UseImageSpacingOn();
    filter->InsideIsPositiveOff();
    filter->Update();
    return filter->GetOutput();
}
#endif

TEST(DistanceTransform, IsWhatItkSays) {
#if STEREONAV_COMPARE_ITK
    test::Random random(1);
    for (const glm::dvec3& spacing : {glm::dvec3(1e-3), glm::dvec3(0.8e-3, 0.8e-3, 0.7e-3)}) {
        MaskVolume mask(test::slantedFrame({60, 50, 70}, spacing));
        for (std::size_t n = 0; n < mask.values.size(); ++n) mask.values[n] = random.between(0, 1) < 0.9995;
        const auto theirs = maurer(mask);
        const DistanceVolume ours = distanceToOutside(mask, false);
        for (std::size_t n = 0; n < mask.values.size(); ++n) {
            if (!mask.values[n]) continue;
            const double units = theirs->GetBufferPointer()[n] / ours.unit;
            ASSERT_LE(ours.values[n], units * (1 + 1e-6)) << n;
            ASSERT_GT(ours.values[n], units * (1 - 1e-6) - 1) << n;
        }
    }
#else
    GTEST_SKIP() << "ITK was not found when this was built";
#endif
}

}  // namespace
}  // namespace stereonav
