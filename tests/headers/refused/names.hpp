// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

// Names what another header declares, which it does not include.
inline void take(const Declared&) {}
