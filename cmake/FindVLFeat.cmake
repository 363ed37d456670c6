# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT

# VLFeat, which brings no package file of its own: VLFeat_INCLUDE_DIRS, VLFeat_LIBRARIES. For benchmarks only.
find_path(VLFeat_INCLUDE_DIRS vl/covdet.h)
find_library(VLFeat_LIBRARIES vl)
mark_as_advanced(VLFeat_INCLUDE_DIRS VLFeat_LIBRARIES)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(VLFeat DEFAULT_MSG VLFeat_LIBRARIES VLFeat_INCLUDE_DIRS)
