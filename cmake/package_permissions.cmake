# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT

# Run by cpack before it packs what it has gathered: folders are for all to read, whatever the mask of who packs
# (CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS is masked, too).
file(CHMOD_RECURSE "${CPACK_TEMPORARY_INSTALL_DIRECTORY}" DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE
     GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
