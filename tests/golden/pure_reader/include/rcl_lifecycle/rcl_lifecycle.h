#error "The component 'lifecycle' is not in this version yet"
