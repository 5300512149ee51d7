#include "base/number_text.h"
#include "facet/compare.h"

namespace facet {

std::vector<std::string> BrokenThresholds(const ImageDifference& difference, const CompareThresholds& thresholds) {
  std::vector<std::string> broken;
  bool any = false;
  const auto at_most = [&](const char* what, double value, const auto& bound) {
    if (!bound) return;
    any = true;
    const double limit = static_cast<double>(*bound);
    if (!(value <= limit)) broken.push_back(what + ShortNumber(value) + " is above " + ShortNumber(limit));
  };
  const auto at_least = [&](const char* what, double value, const std::optional<double>& bound) {
    if (!bound) return;
    any = true;
    if (!(value >= *bound)) broken.push_back(what + ShortNumber(value) + " is below " + ShortNumber(*bound));
  };
  at_most("the largest difference ", difference.max_difference, thresholds.max_difference);
  if (thresholds.max_pixels) {
    any = true;
    if (difference.differing_pixels > *thresholds.max_pixels) {
      broken.push_back("the number of differing pixels " + std::to_string(difference.differing_pixels) + " is above " +
                       std::to_string(*thresholds.max_pixels));
    }
  }
  at_most("RMSE ", difference.rmse, thresholds.max_rmse);
  at_least("PSNR ", difference.psnr_db, thresholds.min_psnr_db);
  at_least("SSIM ", difference.ssim, thresholds.min_ssim);
  at_most("FLIP ", difference.flip_mean, thresholds.max_flip);
  if (!any && !difference.equal) broken.push_back("the pictures differ");
  return broken;
}

}  // namespace facet
