// What the parameters of the model "enterprise" say of the medium, where that is the same for the whole surface.
#pragma once

#include "facet/models/enterprise.h"
#include "material/parameters.h"

namespace facet {

// The reflectance at normal incidence, the indices of refraction for red, green and blue, the absorption per metre and
// the thickness. `p`: of a plan (plan/enterprise_measures.h), in which the thickness is known.
//
// Red, green and blue are the Fraunhofer lines C, d and F, between which the Abbe number is defined, by Cauchy's
// equation with two terms. Light that the medium scatters forwards goes on as if it had not been scattered: the
// extinction is that of the similarity relation, sigma_t (1 - g albedo), with the albedo of one scattering event from
// the colour of many (Kulla and Conty, 2017, Revisiting Physically Based Shading at Imageworks).
void SetEnterpriseFactors(const EnterpriseParameters& p, MaterialFactors& factors);

// The albedo of one scattering event of a medium that, scattering many times, has this albedo. In [0, 1].
double SingleScatteringAlbedo(double multiple);

}  // namespace facet
