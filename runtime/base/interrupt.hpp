#pragma once
// Ctrl-C in a program that goes on after it.

namespace garment {

/// From now on a second Ctrl-C does not end the program: it is only told by Host::interrupted.
void survive_interrupts();
/// Host::interrupted is false again, until the next Ctrl-C.
void forget_interrupts();

}  // namespace garment
