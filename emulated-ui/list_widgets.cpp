// SPDX-License-Identifier: GPL-3.0-or-later
// Writes docs/reference/widgets.md to standard output: list-widgets > docs/reference/widgets.md
#include <iostream>

#include "emulated-ui/widget_list.h"

int main() {
  const auto list = standpoint::widgetList();
  if (!list) {
    std::cerr << standpoint::describe(list.error()) << '\n';
    return 1;
  }
  std::cout << *list;
  return 0;
}
