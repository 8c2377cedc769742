# SPDX-License-Identifier: GPL-2.0-or-later
PUBLIC_HEADERS += src/hal/hal.h
