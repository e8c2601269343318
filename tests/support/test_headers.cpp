// Carries the precompiled headers of the tests (see HemoScaleTest.cmake).
int main() {
  return 0;
}
