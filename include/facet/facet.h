// Everything a user of the library includes.
#pragma once

#include "facet/check.h"
#include "facet/compare.h"
#include "facet/digest.h"
#include "facet/error.h"
#include "facet/explain.h"
#include "facet/film.h"
#include "facet/image.h"
#include "facet/load.h"
#include "facet/planes.h"
#include "facet/render.h"
#include "facet/report.h"
#include "facet/scene.h"
#include "facet/settings.h"
#include "facet/shader.h"
#include "facet/verify.h"
#include "facet/version.h"
