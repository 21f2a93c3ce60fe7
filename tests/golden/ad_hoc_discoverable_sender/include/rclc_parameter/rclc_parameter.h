#error "The component 'parameters' is not in this version yet"
